set datafile separator ','
set datafile missing 'nan'
set terminal pngcairo size 1100,750 font 'DejaVu Sans,12'
set output 'energy_over_dt.png'
set logscale xy
set xtics ('12.5 ms' 0.0125, '25 ms' 0.025, '50 ms' 0.05, '100 ms' 0.1, '200 ms' 0.2)
set format y '10^{%L}'
set grid lc rgb '#dddddd' lw 1
set border 3 lc rgb '#555555'
set tics nomirror
set key outside right top Left reverse samplen 2 spacing 1.3
set xlabel 'time step; the bar turns by 1 rad/s'
set ylabel 'energy error in 5 s, relative to the energy'
set title 'Stiff spinning bar: energy error against the time step'
set xrange [0.0115:0.22]
set yrange [1e-8:3]
set label 'slope 1' at 0.052,0.03 tc rgb '#555555'
set label 'slope 3' at 0.052,1.2e-6 tc rgb '#555555'
plot sample [x=0.0125:0.2] '+' using 1:(0.9*$1) with lines dt 2 lw 1.5 lc rgb '#777777' notitle, \
     [x=0.0125:0.2] '+' using 1:(0.02*$1**3) with lines dt 2 lw 1.5 lc rgb '#777777' notitle, \
     'energy_over_dt.csv' using 1:(abs(column('backward_euler'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 5 lc rgb '#a50f15' title 'backward euler', \
     'energy_over_dt.csv' using 1:(abs(column('sdirk2'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 7 lc rgb '#de2d26' title 'sdirk2', \
     'energy_over_dt.csv' using 1:(abs(column('sdirk3'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 9 lc rgb '#fb6a4a' title 'sdirk3', \
     'energy_over_dt.csv' using 1:(abs(column('bdf2'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 11 lc rgb '#756bb1' title 'bdf2', \
     'energy_over_dt.csv' using 1:(abs(column('sdirk_ncs23'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 4 lc rgb '#969696' title 'sdirk ncs23', \
     'energy_over_dt.csv' using 1:(abs(column('tr_bdf2'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 5 lc rgb '#08519c' title 'tr bdf2', \
     'energy_over_dt.csv' using 1:(abs(column('tr_bdf2_b'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 7 lc rgb '#3182bd' title 'tr bdf2 b', \
     'energy_over_dt.csv' using 1:(abs(column('esdirk324'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 9 lc rgb '#006d2c' title 'esdirk324', \
     'energy_over_dt.csv' using 1:(abs(column('esdirk325'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 11 lc rgb '#31a354' title 'esdirk325', \
     'energy_over_dt.csv' using 1:(abs(column('esdirk436'))) every ::0::4 with linespoints lw 2 ps 1.3 pt 13 lc rgb '#74c476' title 'esdirk436'
