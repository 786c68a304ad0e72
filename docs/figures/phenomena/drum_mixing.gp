# ./movie scenes/drum_mixing.toml && gnuplot docs/figures/phenomena/drum_mixing.gp
set datafile separator ","
set terminal svg size 640,420 font "sans,13" background "#ffffff"
set output "docs/figures/phenomena/drum_mixing.svg"
set xlabel "revolutions of the drum"
set ylabel "Lacey's mixing index"
set xrange [0:3.5]
set yrange [0:1]
set grid ytics lc rgb "#dddddd"
plot "output/drum_mixing/measures.csv" using (column("revolutions")):(column("lacey")) with lines lw 2 lc rgb "#0072b2" notitle
