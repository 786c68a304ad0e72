# gnuplot docs/figures/phenomena/shallow_bed.gp, in the folder where
# tests/phenomena/bed_states.py --profiles output/shallow_bed/members/*_seed-1_* wrote shallow_*.dat
set terminal pngcairo size 1300,420 font "sans,11"
set output "shallow_bed.png"
set multiplot layout 1,4
set view map
set cbrange [0:0.6]
set palette defined (0 "#ffffff", 0.1 "#cfe1f2", 0.25 "#6aaed6", 0.45 "#2070b4", 0.6 "#08306b")
set xlabel "phase of the drive, turns"
set xrange [0:1]
set yrange [0:20]
set xtics 0.5
unset colorbox
set ylabel "height above the floor, diameters"
set title "1 diameter: Newtonian-I"
plot "shallow_116.dat" using 1:2:3 with image notitle
unset ylabel
set title "2: Newtonian-II"
plot "shallow_232.dat" using 1:2:3 with image notitle
set title "4: coherent-expanded"
plot "shallow_464.dat" using 1:2:3 with image notitle
set title "10: coherent-condensed"
set colorbox
set cblabel "solid fraction"
plot "shallow_1160.dat" using 1:2:3 with image notitle
