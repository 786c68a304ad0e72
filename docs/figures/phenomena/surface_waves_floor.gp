# At 22 Hz and friction 0 the three seeds are equal: no interval is drawn there. The rows are those of surface_waves_floor.csv: gnuplot surface_waves_floor.gp
set terminal svg size 640,420 font "sans,13" background "#ffffff"
set output "surface_waves_floor.svg"
set xlabel "friction of floor and walls"
set ylabel "wavelength, mm"
set xrange [-0.05:0.55]
set yrange [0:55]
set border 3
set tics nomirror out
set grid ytics lc rgb "#dddddd"
set key bottom right
$f15 << END
0 38.10 8.20
0.1 38.10 8.20
0.2 38.28 11.98
0.5 38.10 8.20
END
$f22 << END
0 34.29 0.00
0.1 32.10 5.33
0.2 34.40 6.12
0.5 32.27 8.68
END
plot $f15 using ($1-0.004):2:3 with yerrorbars pt 7 lw 2 lc rgb "#0072b2" title "15 Hz", $f22 using ($1+0.004):2:3 with yerrorbars pt 5 lw 2 lc rgb "#d55e00" title "22 Hz"
