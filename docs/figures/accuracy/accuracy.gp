# Draws contacts.csv, convergence.csv, spins.csv, gas.csv and bed.csv, and the other engines of peers.csv (made by
# tests/peers/impacts.sh) where that lies beside them: gnuplot accuracy.gp
set datafile separator ','
set style data linespoints
set grid
set key outside right top maxcols 1 width -4 font ',12'
set logscale xy
set format y "10^{%L}"
methods = "'velocity Verlet' 'with corrections' 'mixed precision' 'leapfrog' 'position Verlet' 'Forest-Ruth' 'Gear' 'spring-dashpot' 'Hertz-Mindlin'"
pick(method, error, e) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && $3==%s {print $4\",\"$5\",\"$6}' contacts.csv", method, error, e)
peer(e) = sprintf("< awk -F, '$1==\"LAMMPS\" && $3==%s {print $4\",\"$5\",\"$6}' peers.csv 2>/dev/null", e)

do for [form in "svg png"] {
    if (form eq "svg") { set terminal svg size 900,740 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1350,1110 font 'DejaVu Sans,18' }
    set xrange [*:*]
    set output 'oblique.'.form
    set xlabel 'cost of a contact, ns of one thread'
    set multiplot layout 2,1
    set ylabel 'largest error / speed'
    set title 'Tangential velocity after an impact at 0 to 85 degrees, e = 0.9'
    plot for [m in methods] pick(m, 'velocity', '0.9') using 2:3 title m lw 2
    set title 'Energy drift after 1,000 elastic bounces'
    set ylabel '|dE| / E'
    plot for [m in methods] pick(m, 'energy drift', '0.9') using 2:($3 > 1e-15 ? $3 : 1e-15) title m lw 2
    unset multiplot
    unset title
    set output 'convergence.'.form
    set logscale xy
    set multiplot layout 2,1
    laws = "'slip' 'slip; corrected' 'spring' 'spring; corrected'"
    of(contact, law) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" {print $3\",\"$4}' convergence.csv", contact, law)
    set xlabel 'steps in a contact'
    set ylabel 'largest error / speed'
    set xrange [7:450]
    set yrange [1e-6:0.1]
    do for [contact in "impact lasting"] {
        set title contact eq 'impact' ? 'Tangential velocity after an impact at 0 to 85 degrees, e = 0.9' : 'Tangential velocity in a lasting contact that sticks'
        plot for [l in laws] of(contact, l) using 1:2 title l lw 2 ps 0.7, 0.4/x lc 'gray40' dt 2 title 'slope 1', 0.8/x**2 lc 'gray40' dt 3 title 'slope 2'
    }
    unset multiplot
    unset title
    set autoscale
    set output 'spins.'.form
    set logscale y
    unset logscale x
    set format x '%g'
    set multiplot layout 2,1
    laws = "'Walton-Braun' 'Walton-Braun by speed' 'Walton-Braun; linear spring' 'spring-dashpot; slip' 'spring-dashpot' 'Hertz-Mindlin'"
    at(law, e) = sprintf("< awk -F, '$1==\"%s\" && $2==%s {print $3\",\"$5\",\"$6}' spins.csv", law, e)
    set xlabel 'angle of the impact from the normal, degrees'
    set xrange [0:85]
    set xtics 10
    do for [k=2:3] {
        set ylabel k==2 ? 'largest error / speed' : 'largest error / spin'
        set title k==2 ? "Tangential velocity after an impact, at the plan's step : e = 0.9 (lines), 0.5 (dashes) " : "Spin after an impact, at the plan's step"
        set yrange [1e-5:(k==2 ? 0.1 : 1)]
        plot for [m=1:6] at(word(laws, m), '0.9') using 1:k title word(laws, m) lw 2 lc m pt m, \
             for [m=1:6] at(word(laws, m), '0.5') using 1:k notitle lw 1.5 lc m pt m ps 0.6 dt 2, \
             0.0008 lc 'gray30' lw 2 dt 3 title 'error of e, standard'
    }
    unset multiplot
    unset title
    set xtics autofreq
    set autoscale
    set logscale xy
    set output 'speed.'.form
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
    set output 'gas.'.form
    set logscale xy
    set multiplot layout 2,1
    # As they are coloured above, where `mixed precision` is the third.
    elastic = "'velocity Verlet' 'with corrections' '' 'leapfrog' 'position Verlet' 'Forest-Ruth' 'Gear' 'spring-dashpot'"
    planned = 'Walton-Braun as planned'
    # Root mean square over the seeds, of what is gained over the energy, or over what is lost.
    over_time(m) = sprintf("< awk -F, '$1==\"%s\" && $2==1 {s[$4] += $6^2; n[$4]++} END {for (x in s) print x\",\"sqrt(s[x]/n[x])}' gas.csv | sort -g", m)
    over_loss(m) = sprintf("< awk -F, '$1==\"%s\" && $2<1 {x = 1-$2^2; s[x] += ($6/$7)^2; n[x]++} END {for (x in s) print x\",\"sqrt(s[x]/n[x])}' gas.csv | sort -g", m)
    set xrange [200:10000]
    set xlabel 'time over the duration of a contact'
    set ylabel '|gained energy| / energy'
    set title 'An elastic gas of 216 smooth grains'
    plot for [k in "1 2 4 5 6 7 8"] over_time(word(elastic, k+0)) using 1:2 title word(elastic, k+0) lw 2 lc (k+0) pt (k+0), over_time('Hertz') using 1:2 title 'Hertz' lw 2 lc 'gray50' pt 9, over_time(planned) using 1:2 title planned with points pt 6 ps 1.5 lw 2 lc 'black'
    set xrange [0.3:1e-4]
    set yrange [1e-4:2]
    set format x "10^{%L}"
    set xlabel '1 - e^2, the share of its energy that an impact takes'
    set ylabel '|gained energy| / lost energy'
    set title 'Nearly elastic gases'
    plot for [k=1:2] over_loss(word(elastic, k)) using 1:2 title word(elastic, k) lw 2 lc k pt k, over_loss(planned) using 1:2 title planned with points pt 6 ps 1.5 lw 2 lc 'black', 1 lc 'gray30' lw 2 dt 2 title 'nothing is lost'
    unset multiplot
    unset title
    set format x '%g'
    set autoscale
    set output 'bed.'.form
    unset logscale
    set format xy '%g'
    set offsets 0, 0, 0.5, 0.5
    set yrange [] reverse
    set multiplot layout 2,2 title 'A vibrated bed of 1,000 grains against its reference (an eighth of the default step)'
    unset key
    unset ylabel
    set xtics font ',10'
    do for [k=1:4] {
        set xlabel word('height temperature contacts mixing', k).', difference in %'
        plot 'differences.csv' every ::1 using (column(2*k+1)):0:(column(2*k+2)):ytic(1) with xerrorbars pt 7 lw 2 notitle
    }
    unset multiplot
    unset offsets
    set yrange [] noreverse
    set ytics auto
    set xtics font ',14'
    set ylabel
    set format x '%g'
    set key outside right top maxcols 1 width -4 font ',12'
    set logscale xy
    set format y "10^{%L}"
}
