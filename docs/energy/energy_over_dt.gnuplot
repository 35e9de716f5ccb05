set datafile separator ','
set datafile missing 'nan'
set logscale y
set format y '10^{%L}'
set grid lc rgb '#cccccc' lt 1 lw 0.5
set key outside right noenhanced samplen 2
set border lc rgb '#444444'
set terminal pngcairo size 1000,640 font 'DejaVu Sans,11'
set output 'energy_over_dt.png'
set logscale x
set format x '10^{%L}'
set xlabel 'time step [s]'
set ylabel 'energy error at t = 10 s [J/kg]'
set xrange [0.7e-4:0.14]
set yrange [1e-11:10]
set title 'Clamped beam, 10 s: energy error against the time step (in brackets: slope)'
plot 'energy_over_dt.csv' using 1:(column('backward_euler') > 0 ? column('backward_euler') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#b2182b' pt 4 ps 0.8 title 'backward_euler (0.74)', \
     'energy_over_dt.csv' using 1:(column('sdirk2') > 0 ? column('sdirk2') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#0072b2' pt 5 ps 0.8 title 'sdirk2 (2.77)', \
     'energy_over_dt.csv' using 1:(column('tr_bdf2') > 0 ? column('tr_bdf2') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#56b4e9' pt 6 ps 0.8 title 'tr_bdf2 (2.52)', \
     'energy_over_dt.csv' using 1:(column('tr_bdf2_b') > 0 ? column('tr_bdf2_b') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#e69f00' pt 7 ps 0.8 title 'tr_bdf2_b (2.50)', \
     'energy_over_dt.csv' using 1:(column('sdirk3') > 0 ? column('sdirk3') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#f0c808' pt 8 ps 0.8 title 'sdirk3 (2.93)', \
     'energy_over_dt.csv' using 1:(column('sdirk_ncs23') > 0 ? column('sdirk_ncs23') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#009e73' pt 9 ps 0.8 title 'sdirk_ncs23 (2.85)', \
     'energy_over_dt.csv' using 1:(column('sdirk_nc34') > 0 ? column('sdirk_nc34') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#66c2a4' pt 10 ps 0.8 title 'sdirk_nc34 (3.72)', \
     'energy_over_dt.csv' using 1:(column('sdirk_3345') > 0 ? column('sdirk_3345') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#7b3294' pt 11 ps 0.8 title 'sdirk_3345 (3.22)', \
     'energy_over_dt.csv' using 1:(column('sdirk_4347') > 0 ? column('sdirk_4347') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#c2a5cf' pt 12 ps 0.8 title 'sdirk_4347 (3.58)', \
     'energy_over_dt.csv' using 1:(column('implicit_midpoint') > 0 ? column('implicit_midpoint') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#444444' pt 13 ps 0.8 title 'implicit_midpoint (1.90)', \
     'energy_over_dt.csv' using 1:(column('trapezoid') > 0 ? column('trapezoid') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#999999' pt 4 ps 0.8 title 'trapezoid (1.90)', \
     'energy_over_dt.csv' using 1:(column('esdirk324') > 0 ? column('esdirk324') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#d6604d' pt 5 ps 0.8 title 'esdirk324 (2.49)', \
     'energy_over_dt.csv' using 1:(column('esdirk325') > 0 ? column('esdirk325') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#8c510a' pt 6 ps 0.8 title 'esdirk325 (2.99)', \
     'energy_over_dt.csv' using 1:(column('esdirk436') > 0 ? column('esdirk436') : NaN) every ::0::8 with linespoints lw 1.8 lc rgb '#1b7837' pt 7 ps 0.8 title 'esdirk436 (4.74)'
