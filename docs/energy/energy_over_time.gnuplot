set datafile separator ','
set datafile missing 'nan'
set logscale y
set format y '10^{%L}'
set grid lc rgb '#cccccc' lt 1 lw 0.5
set key outside right noenhanced samplen 2
set border lc rgb '#444444'
set terminal pngcairo size 1000,820 font 'DejaVu Sans,11'
set output 'energy_over_time.png'
set xlabel 'time [s]'
set ylabel 'energy error [J/kg]'
set xrange [0:200]
set multiplot layout 2,1
set title 'Clamped beam, steps of 33 ms'
set yrange [1e-3:5]
plot '< grep -E "^backward_euler,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#b2182b' title 'backward_euler', \
     '< grep -E "^sdirk2,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#0072b2' title 'sdirk2', \
     '< grep -E "^tr_bdf2,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#56b4e9' title 'tr_bdf2', \
     '< grep -E "^tr_bdf2_b,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#e69f00' title 'tr_bdf2_b', \
     '< grep -E "^sdirk3,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#f0c808' title 'sdirk3', \
     '< grep -E "^sdirk_ncs23,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#009e73' title 'sdirk_ncs23', \
     '< grep -E "^sdirk_nc34,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#66c2a4' title 'sdirk_nc34', \
     '< grep -E "^sdirk_3345,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#7b3294' title 'sdirk_3345', \
     '< grep -E "^sdirk_4347,0.033," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#c2a5cf' title 'sdirk_4347'
set title 'Clamped beam, steps of 5 ms'
set yrange [1e-5:5]
plot '< grep -E "^backward_euler,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#b2182b' title 'backward_euler', \
     '< grep -E "^sdirk2,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#0072b2' title 'sdirk2', \
     '< grep -E "^tr_bdf2,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#56b4e9' title 'tr_bdf2', \
     '< grep -E "^tr_bdf2_b,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#e69f00' title 'tr_bdf2_b', \
     '< grep -E "^sdirk3,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#f0c808' title 'sdirk3', \
     '< grep -E "^sdirk_ncs23,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#009e73' title 'sdirk_ncs23', \
     '< grep -E "^sdirk_nc34,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#66c2a4' title 'sdirk_nc34', \
     '< grep -E "^sdirk_3345,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#7b3294' title 'sdirk_3345', \
     '< grep -E "^sdirk_4347,0.005," energy_over_time.csv' using 3:($4 > 0 ? $4 : NaN) with lines lw 1.8 lc rgb '#c2a5cf' title 'sdirk_4347'
unset multiplot
