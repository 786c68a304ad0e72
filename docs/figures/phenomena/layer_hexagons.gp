# gnuplot docs/figures/phenomena/layer_hexagons.gp, in the folder where tests/phenomena/layer_pattern.py wrote
# hexagons_odd.dat and hexagons_even.dat with --map
set terminal pngcairo size 820,430 font "sans,11"
set output "layer_hexagons.png"
set multiplot layout 1,2
set size ratio 1
set palette defined (0 "#002c5a", 0.5 "#ffffff", 1 "#5c1000")
set xrange [0:100]
set yrange [0:100]
set xlabel "mm"
unset colorbox
set cbrange [-3:3]
set title "odd periods: single peaks (±3 mm)"
plot "hexagons_odd.dat" matrix using ($1*1.515+0.76):($2*1.515+0.76):3 with image notitle
set cbrange [-4:4]
set title "even periods: single holes (±4 mm)"
plot "hexagons_even.dat" matrix using ($1*1.515+0.76):($2*1.515+0.76):3 with image notitle
