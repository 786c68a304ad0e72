// Speed against accuracy at one look: the errors of single contacts (contacts.csv) and of a bed
// (differences.csv) against the cost, beside the other engines' own steps.
#include "engine/lab/chart/accuracy/accuracy.hpp"

namespace grainreel {

// LAMMPS' examples take 36 steps in a contact (stiffness 2e5 m g/d and 1e-4 of its time). LIGGGHTS advises 10
// to 30 % of the Rayleigh time, which are 26 to 9 steps for the grains of the charts with E = 5 MPa. Its
// contact is taken to cost LAMMPS' 44 ns by the ratio of their speeds, 57 ns (docs/notes/performance.md).
const char* speed_drawing() {
    return R"(    set output 'speed.'.form
    set logscale xy
    set key at screen 0.995, 0.93 right top width -2
    set format x '%g'
    set lmargin at screen 0.09
    set rmargin at screen 0.69
    shown = "'with corrections' 'spring-dashpot' 'Hertz-Mindlin'"
    words = "'Walton-Braun (default)' 'spring-dashpot' 'Hertz-Mindlin'"
    planned = '12 45 45'
    colour(k) = word('#0072b2 #e69f00 #009e73', k)
    # Cost of one force, ns, by contacts.csv.
    cost(m) = real(system(sprintf("awk -F, '$1==\"%s\" && $2==\"restitution\" && $3==0.9 && $4==12 {print $5/$4}' contacts.csv", m)))
    at(m, error, n) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && $3==0.9 && $4%s {print $4\",\"$5\",\"$6}' contacts.csv", m, error, n)
    near(n) = n==45 ? '==40' : '=='.n
    # Settings of the bed, as steps in a contact.
    bed(column) = sprintf("< awk -F, '$1==\"step x 2\" {n=6} $1==\"default\" {n=12} $1==\"step x 0.5\" {n=24} n {print n\",\"$%d\",\"$%d; n=0}' differences.csv | sort -g", column, column+1)
    set multiplot layout 3,1
    set xrange [60:6000]
    unset xlabel
    set ylabel 'largest error of e'
    set title 'Restitution of a head-on impact, e = 0.9'
    plot for [k=1:3] at(word(shown,k), 'restitution', '>0') using 2:3 with lines lw 2 lc rgb colour(k) title word(words,k), \
         for [k=1:3] at(word(shown,k), 'restitution', near(word(planned,k))) using 2:3 with points pt 7 ps 1.4 lc rgb colour(k) notitle, \
         NaN with points pt 7 ps 1.4 lc 'gray40' title "the plan's own step", \
         peer('0.9') using 2:3 with lines lw 2 dt 2 lc 'black' title 'LAMMPS, spring-dashpot', \
         peer('0.9') using ($1==32 ? $2*36./32 : NaN):($3*32./36) with points pt 9 ps 1.6 lc 'black' title "LAMMPS' examples: 36 steps", \
         at('Hertz-Mindlin', 'restitution', '<=28') using ($1>=8 ? $1*57 : NaN):3 with lines lw 6 lc rgb '#cc79a7' title 'LIGGGHTS: 10-30 % of Rayleigh'
    unset key
    set ylabel 'largest error / speed'
    set title 'Radius x spin after an impact at 0 to 85 degrees, e = 0.9'
    plot for [k=1:3] at(word(shown,k), 'spin', '>0') using 2:3 with lines lw 2 lc rgb colour(k) notitle, \
         for [k=1:3] at(word(shown,k), 'spin', near(word(planned,k))) using 2:3 with points pt 7 ps 1.4 lc rgb colour(k) notitle, \
         at('spring-dashpot', 'spin', '==40') using (36*44):($3*40./36) with points pt 9 ps 1.6 lc 'black' notitle, \
         at('Hertz-Mindlin', 'spin', '<=28') using ($1>=8 ? $1*57 : NaN):3 with lines lw 6 lc rgb '#cc79a7' notitle
    unset logscale y
    set format y '%g'
    set xlabel 'cost of a contact: its forces x ns of one thread for a force'
    set ylabel 'difference, %'
    set title 'A shaken bed, default law, against steps of an eighth'
    set yrange [-6:6]
    set key at screen 0.995, 0.28 right top width -2
    c = cost('with corrections')
    plot bed(3) using ($1*c):2:3 with yerrorlines lw 2 pt 7 ps 0.9 lc rgb colour(1) title 'mean height', \
         bed(5) using ($1*c*1.03):2:3 with yerrorlines lw 2 dt 2 pt 6 ps 0.9 lc rgb colour(1) title 'granular temperature', 0 lc 'gray50' lw 1 notitle
    unset multiplot
    unset title
    set lmargin
    set rmargin
    set autoscale
    set logscale xy
    set format y "10^{%L}"
    set key outside right top maxcols 1 width -4 font ',12'
)";
}

}  // namespace grainreel
