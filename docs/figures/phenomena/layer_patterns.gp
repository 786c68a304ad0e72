# gnuplot docs/figures/phenomena/layer_patterns.gp, in the folder where tests/phenomena/layer_pattern.py wrote
# stripes.dat and squares.dat with --map
set terminal pngcairo size 900,430 font "sans,11"
set output "layer_patterns.png"
set multiplot layout 1,2
set size ratio 1
set palette defined (0 "#002c5a", 0.5 "#ffffff", 1 "#5c1000")
set cbrange [-4:4]
set xrange [0:100]
set yrange [0:100]
set xlabel "mm"
set cblabel "part of the surface that is inverted every period, mm"
unset colorbox
set title "f√(h/g) = 0.43, 5.2 diameters, after 45 periods"
plot "stripes.dat" matrix using ($1*1.515+0.76):($2*1.515+0.76):3 with image notitle
set colorbox
set title "0.27, 2.9 diameters, after 60 periods"
plot "squares.dat" matrix using ($1*1.515+0.76):($2*1.515+0.76):3 with image notitle
