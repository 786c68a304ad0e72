# gnuplot docs/figures/phenomena/wedge_mixture_fields.gp, in the folder where tests/phenomena/mixture_fields.py wrote mixture_*.dat
set terminal pngcairo size 1400,400 font "sans,11"
set output "wedge_mixture_fields.png"
set multiplot
set size ratio -1
set xrange [-46:46]
set yrange [0:80]
set xtics 20
set xlabel "across, mm"
set palette defined (0 "#ffffff", 0.2 "#fddbc7", 0.4 "#f4a582", 0.7 "#d6604d", 1 "#67001f")
set cbrange [0:1]
unset colorbox
unset key
scale = 0.4  # mm of arrow for a mm/s
set tmargin at screen 0.9
set bmargin at screen 0.14
set arrow 1 from 26,75 to 34,75 head size 1.5,25 filled lc "#202020" front
set label 1 "20 mm/s" at 24,75 right front
set lmargin at screen 0.050
set rmargin at screen 0.255
set title "0 to 1 s"
set ylabel "above the floor, mm"
plot "mixture_0.5.dat" using 1:2:3 with image, "" every 2:2 using 1:2:(scale*$4):(scale*$5) with vectors head size 1.5,25 filled lc "#202020"
set lmargin at screen 0.268
set rmargin at screen 0.473
set title "2 to 3 s"
unset ylabel
set format y ""
plot "mixture_2.5.dat" using 1:2:3 with image, "" every 2:2 using 1:2:(scale*$4):(scale*$5) with vectors head size 1.5,25 filled lc "#202020"
set lmargin at screen 0.486
set rmargin at screen 0.691
set title "5 to 6 s"
plot "mixture_5.5.dat" using 1:2:3 with image, "" every 2:2 using 1:2:(scale*$4):(scale*$5) with vectors head size 1.5,25 filled lc "#202020"
set lmargin at screen 0.704
set rmargin at screen 0.909
set title "9 to 10 s"
set colorbox user origin screen 0.925, screen 0.14 size screen 0.012, screen 0.62
set cblabel "share of the big grains in the solid volume"
plot "mixture_9.5.dat" using 1:2:3 with image, "" every 2:2 using 1:2:(scale*$4):(scale*$5) with vectors head size 1.5,25 filled lc "#202020"
