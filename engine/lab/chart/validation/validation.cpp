#include "engine/lab/chart/validation/validation.hpp"

#include <algorithm>

namespace grainreel {

namespace {

const std::vector<const ValidationPart*>& parts() {
    static const std::vector<const ValidationPart*> all = {&impact_part, &gas_part, &packing_part,
                                                           &silo_part};
    return all;
}

}  // namespace

bool run_validation(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    std::size_t pieces = 0;
    for (const ValidationPart* part : parts()) pieces += part->pieces(request.quick);
    ChartWork work(watcher, pieces);
    return std::all_of(parts().begin(), parts().end(),
                       [&](const ValidationPart* part) { return part->run(request, work); });
}

// The commands for gnuplot that draw the tables of all parts.

std::string validation_drawing() {
    return R"(# Draws the tables beside it: gnuplot validation.gp
set datafile separator ','
set grid
rows(file, column, value) = sprintf("< awk -F, '$%d==\"%s\"' %s", column, value, file)

do for [form in "svg png"] {
    if (form eq "svg") { size_1 = "svg size 900,480 font 'DejaVu Sans,14' background 'white'"; size_3 = "svg size 900,1080 font 'DejaVu Sans,14' background 'white'"; size_2 = "svg size 900,760 font 'DejaVu Sans,14' background 'white'" }
    else { size_1 = "pngcairo size 1350,720 font 'DejaVu Sans,18'"; size_3 = "pngcairo size 1350,1620 font 'DejaVu Sans,18'"; size_2 = "pngcairo size 1350,1140 font 'DejaVu Sans,18'" }

    eval "set terminal ".size_3
    set output 'alumina.'.form
    set multiplot layout 3,1 title 'Alumina on glass, 3.85 m/s: Kharaz, Gorham and Salman 2001'
    set key outside right top
    set xrange [0:90]
    set xlabel 'angle of incidence, degrees from the normal'
    set ylabel 'tangential restitution'
    set yrange [0.4:1]
    plot rows('alumina_points.csv', 1, 'tangential restitution') using 2:3 with points pt 7 ps 0.9 lc 'black' title 'measured', \
        for [law in "'incremental slip' 'Hertz-Mindlin'"] rows('alumina.csv', 1, law) using 2:3 with lines lw 2 title law
    set yrange [0:*]
    set ylabel 'spin after, rad/s'
    plot rows('alumina_points.csv', 1, 'spin rad/s') using 2:3 with points pt 7 ps 0.9 lc 'black' title 'measured', \
        for [law in "'incremental slip' 'Hertz-Mindlin'"] rows('alumina.csv', 1, law) using 2:4 with lines lw 2 title law
    set ylabel 'angle of rebound, degrees'
    plot rows('alumina_points.csv', 1, 'rebound deg') using 2:3 with points pt 7 ps 0.9 lc 'black' title 'measured', \
        for [law in "'incremental slip' 'Hertz-Mindlin'"] rows('alumina.csv', 1, law) using 2:5 with lines lw 2 title law
    unset multiplot
    set autoscale

    eval "set terminal ".size_1
    set output 'binary.'.form
    set title 'Slip after a binary impact: Foerster, Louge, Chang and Allia 1994'
    set xlabel 'slip before over normal speed before'
    set ylabel 'slip after over normal speed before'
    material(k) = word('glass acetate', k)
    slips(m, law) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\"' binary.csv", m, law)
    plot for [k=1:2] slips(material(k), 'linear spring') using 3:5 with lines dt 2 lw 2 lc k title material(k).', their lines', \
        for [k=1:2] slips(material(k), 'incremental slip') using 3:4 with points pt 7 ps 0.6 lc k title material(k).', incremental slip', \
        for [k=1:2] slips(material(k), 'linear spring') using 3:4 with points pt 6 ps 0.8 lc k title material(k).', linear spring'

    set output 'haff.'.form
    set title "A gas that cools, e = 0.9, solid fraction 0.05: Haff 1983"
    set xlabel 'time over {/Symbol t}'
    set ylabel 'T / T_0'
    set logscale y
    set xrange [0:5.2]
    plot 1 / (1 + x)**2 with lines lw 2 lc 'black' title 'Haff', \
        rows('haff.csv', 1, '10000') using 2:3:4 with yerrorbars pt 7 ps 0.7 title '10 kN/m', \
        rows('haff.csv', 1, '160000') using 2:3:4 with yerrorbars pt 6 ps 1.1 title '160 kN/m'
    unset logscale
    set autoscale

    eval "set terminal ".size_2
    set output 'packing.'.form
    set multiplot layout 2,1 title 'Jammed spheres, decompressed'
    unset title
    mus = "0 0.1 0.5 10"
    set xrange [0:0.0105]
    set xlabel 'pressure p d / K'
    set ylabel 'solid fraction'
    set yrange [0.54:0.67]
    plot for [k=1:4] rows('packing.csv', 1, word(mus, k)) using 4:5 with points pt 7 ps 0.6 title 'friction '.word(mus, k), \
        0.639 with lines dt 2 lc 'black' title "O'Hern et al., 0.639", \
        0.555 with lines dt 3 lc 'black' title 'random loose, 0.555'
    set xrange [0:0.103]
    set yrange [3.8:7.4]
    set xlabel '(p d / K)^{1/2}'
    set ylabel 'contacts a grain'
    plot for [k=1:4] rows('packing.csv', 1, word(mus, k)) using (sqrt($4)):6 with points pt 7 ps 0.6 title 'friction '.word(mus, k), \
        6 with lines dt 2 lc 'black' title 'isostatic, 6', \
        4 with lines dt 3 lc 'black' title 'with friction, 4'
    unset multiplot
    set autoscale

    eval "set terminal ".size_1
    set output 'janssen.'.form
    set title 'What of its weight a column lays on the floor'
    set xlabel 'filling: mass over that of a column one bore high'
    set ylabel 'apparent mass, likewise'
    set xrange [0:*]
    set yrange [0:3.5]
    K(mu) = real(system(sprintf("awk -F, '$1==\"%s\" {print $2}' janssen_fit.csv", mu)))
    law(x, mu) = (1 - exp(-4*mu*x)) / (4*mu)
    slide = 0.2 * K('0.2'); roll = 0.5 * K('0.5')
    plot x with lines dt 2 lc 'gray' title 'hydrostatic', \
        law(x, slide) with lines lw 2 lc 1 title sprintf('Janssen, K = %.2f', slide / 0.2), \
        rows('silo.csv', 1, '0.2') using 4:5 with points pt 7 ps 0.7 lc 1 title 'wall friction 0.2', \
        rows('silo.csv', 1, '0.2') using 4:9 with points pt 6 ps 0.8 lc 1 title '0.2, still at rest', \
        law(x, roll) with lines lw 2 lc 2 title sprintf('Janssen, K = %.2f', roll / 0.5), \
        rows('silo.csv', 1, '0.5') using 4:5 with points pt 5 ps 0.7 lc 2 title 'wall friction 0.5'
    set autoscale
    unset title
}
)";
}

}  // namespace grainreel
