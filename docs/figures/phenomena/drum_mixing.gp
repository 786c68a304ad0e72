# gnuplot docs/figures/phenomena/drum_mixing.gp, in the folder of the program, after
#   ./movie scenes/drum_mixing.toml
#   ./movie scenes/drum_mixing.toml --set mesh.0.turn.rate=6 --duration 3s --out output/drum_mixing_fast
set datafile separator ","
set terminal svg size 640,420 font "sans,13"
set output "docs/figures/phenomena/drum_mixing.svg"
set xlabel "revolutions of the drum"
set ylabel "Lacey's index: 0 segregated, 1 randomly mixed"
set yrange [0:1]
set xrange [0:3.5]
set grid ytics lc rgb "#dddddd"
set key bottom right
plot "output/drum_mixing/measures.csv" using (column("revolutions")):(column("lacey")) with lines lw 2 lc rgb "#0072b2" title "2.5 rad/s, Froude number 0.03", \
     "output/drum_mixing_fast/measures.csv" using (column("revolutions")):(column("lacey")) with lines lw 2 lc rgb "#d55e00" title "6 rad/s, Froude number 0.18"
