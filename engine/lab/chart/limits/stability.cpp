#include "engine/lab/chart/limits/stability.hpp"

#include "engine/base/numbers.hpp"
#include "engine/lab/chart/chart.hpp"

namespace grainreel {

std::vector<Experiment> stability_experiments() {
    std::vector<Experiment> all;
    for (const auto& family :
         {step_experiments(), speed_experiments(), restitution_experiments(), friction_experiments(),
          path_experiments(), detachment_experiments(), softness_experiments(), drive_experiments(),
          bed_experiments(), number_experiments()})
        all.insert(all.end(), family.begin(), family.end());
    return all;
}

namespace {

std::string cell(double value) {
    return std::isnan(value) ? "nan" : number(value);
}

void add_rows(const Experiment& experiment, const Finding& finding, ResultTable& limits,
              ResultTable& curves) {
    const std::string& name = experiment.name;
    for (const CurvePoint& point : finding.curve)
        if (!curves.has({name, cell(point.x)}))
            curves.add({name, cell(point.x), cell(point.value), cell(point.theory)});
    const bool compares = finding.theory != 0;
    limits.add({name, experiment.varied, cell(finding.theory), cell(finding.measured),
                cell(compares ? finding.measured / finding.theory : kUnknown), cell(finding.usual),
                experiment.failing == Failing::loud ? "loud" : "silent", experiment.guard});
}

}  // namespace

bool run_stability(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    ResultTable limits(request.folder / "limits.csv",
                       "experiment,varied,theory,measured,ratio,default,kind,guard", 1);
    ResultTable curves(request.folder / "curves.csv", "experiment,x,value,theory", 2);
    const std::vector<Experiment> all = stability_experiments();
    ChartWork work(watcher, all.size());
    for (const Experiment& experiment : all) {
        if (!work.next(experiment.name)) return false;
        if (limits.has({experiment.name})) continue;
        add_rows(experiment, experiment.run(request.quick), limits, curves);
    }
    return true;
}

std::string stability_drawing() {
    return R"gp(# Draws limits.csv and curves.csv: gnuplot stability.gp
set datafile separator ','
set grid
colours = "#c0392b #2471a3 #239b56 #b9770e"
colour(k) = word(colours, k)

# ---- the map: a line a limit; what cannot be given over theory stays in the table ----
rows = "awk -F, 'NR>1 && $5!=\"nan\" && $5>0 {n++; print -n\",\"$1\",\"$5\",\"($6==\"nan\" ? \"nan\" : ($6/$3<1e-4 ? 1.5e-4 : $6/$3))\",\"$7} ' limits.csv"
pick(what) = sprintf("< %s | awk -F, '%s'", rows, what)
count = int(system(rows." | wc -l"))
draw_map = "plot pick('$4!=\"nan\"') using (1e-4):1:($4-1e-4):(0) with vectors nohead lw 9 lc '#a9dfbf' title 'up to where the plan goes', pick('$4!=\"nan\" && $5==\"loud\"') using 3:1 pt 7 ps 1.1 lc rgb colour(1) title 'limit, loud', pick('$4!=\"nan\" && $5==\"silent\"') using 3:1 pt 7 ps 1.1 lc rgb colour(2) title 'limit, silent', pick('$4==\"nan\"') using 3:1 pt 6 ps 1.1 lw 2 lc rgb colour(2) title 'error or figure', pick('1') using (NaN):1:ytic(2) notitle"

# ---- the curves ----
of(name) = sprintf("< awk -F, '$1==\"%s\" {print $2\",\"$3\",\"$4}' curves.csv", name)
measured(k) = sprintf("using 1:2 with points pt %d ps 0.9 lc rgb '%s'", k == 1 ? 7 : k == 2 ? 5 : 9, colour(k))
theory(k) = sprintf("using 1:3 with lines lw 2 lc rgb '%s' notitle", colour(k))
one(name, k, label) = sprintf("of('%s') %s title '%s', of('%s') %s", name, measured(k), label, name, theory(k))
M1 = measured(1)
M2 = measured(2)

do for [form in "svg png"] {
    face(size) = sprintf("DejaVu Sans,%d", size * (form eq "svg" ? 1.0 : 1.3))
    if (form eq "svg") { set terminal svg size 1000,900 font face(14) background 'white' } else { set terminal pngcairo size 1500,1350 font face(14) }
    set output 'limits.'.form
    set logscale x
    set format x "10^{%L}"
    set xrange [1e-4:20]
    set yrange [-count-1:0]
    set arrow 1 from 1, graph 0 to 1, graph 1 nohead lw 2 dt 2 lc 'black' back
    set xlabel 'measured / theory (points), default / theory (bars)'
    set key outside top center horizontal Left reverse samplen 2
    eval draw_map
    unset arrow 1
    set autoscale
    unset logscale
    set format '%g'
    unset ytics
    set ytics

    if (form eq "svg") { set terminal svg size 1200,700 font face(13) background 'white' } else { set terminal pngcairo size 1800,1050 font face(13) }
    set output 'impacts.'.form
    set multiplot layout 2,3 title 'Points: measured. Lines: theory.'
    unset grid; set xtics nomirror; set ytics nomirror; set mxtics 1; set mytics 1; set key inside top left Left reverse vertical samplen 1 spacing 1.1
    set title 'Longest step: growth of a disturbance'; set xlabel 'step / limit'; set ylabel 'growth a step'; set yrange [0.9:2.6]; set key inside top left
    eval "plot ".one('step: pair by velocity-verlet', 1, 'Verlet').", ".one('step: pair by forest-ruth', 2, 'Forest-Ruth').", ".one('step: pair by gear', 3, 'Gear')
    set autoscale y; set logscale y; set format y '%g'
    set title 'Restitution at the step of the plan'; set xlabel 'restitution e'; set ylabel 'largest error of e'; set yrange [1e-5:2e-2]
    eval "plot ".one('restitution 0.02 to 0.999', 1, 'plan; line: allowed')
    set autoscale y; set logscale x
    set title 'Restitution with few steps, plain Verlet'; set xlabel 'steps a contact'; set ylabel 'largest error of e'; set key inside bottom left
    plot of('12 steps a contact (e = 0.9)') @M1 title 'e = 0.9', '' using 1:3 pt 6 ps 1.4 lw 2 lc rgb colour(1) title 'derived', of('12 steps a contact (e = 0.3)') @M2 title 'e = 0.3', '' using 1:3 pt 4 ps 1.4 lw 2 lc rgb colour(2) title 'derived'
    unset logscale; set format '%g'; set key inside bottom left
    set title 'Tunnelling'; set xlabel 'speed / [(r_i + r_j) (K_1/m_{eff})^{1/2}]'; set ylabel 'speed after / before'; set key inside bottom left; set yrange [-1.3:1.3]
    eval "plot ".one('tunnelling through a grain', 1, 'head-on')
    set autoscale y; set key inside bottom right
    set title 'Past each other in one step'; set xlabel 'way of a step / 2 (r_i + r_j)'; set ylabel 'meetings missed'
    eval "plot ".one('past each other in one step', 1, 'measured')
    set title 'Energy after an impact, friction 0.5'; set xlabel 'degrees from the normal'; set ylabel 'largest energy after / before'; set key inside bottom left; set yrange [0.3:1.1]
    eval "plot ".one('grazing at a wall (e = 0.9)', 1, 'wall, e = 0.9').", ".one('grazing at a wall (e = 1)', 2, 'wall, e = 1').", of('grazing in a corner (e = 1)') ".measured(3)." title 'corner, e = 1', 1 lc 'gray' dt 2 notitle"
    unset multiplot
    if (form eq "svg") { set terminal svg size 1200,1000 font face(13) background 'white' } else { set terminal pngcairo size 1800,1500 font face(13) }
    set output 'contacts.'.form
    set multiplot layout 3,3 title 'Points: measured. Lines: theory.'
    set autoscale y; set logscale x; set format x '%g'
    set xtics 100; set title 'Friction without end, 45 degrees'; set xlabel 'friction'; set ylabel 'slip after / before'; set key inside top right
    eval "plot ".one('sticking at friction 1e6', 1, 'sliding, sticking'); set xtics autofreq
    set logscale y; set format y '%g'
    set title 'Twisting pair'; set xlabel 'steps a turn'; set ylabel 'direction of T, error in rad'
    eval "plot ".one('twisting pair', 1, 'a turn')
    unset logscale y; set format y '%g'; set format x '%g'; set yrange [-2.5:0.5]
    set title 'Closed loop of N and T'; set xlabel 'N while T rises / N while T falls'; set ylabel 'energy made / work'; set key inside bottom center
    eval "plot ".one('closed loop of linear-spring', 1, 'linear-spring').", ".one('closed loop of mindlin', 2, 'mindlin').", ".one('closed loop of incremental-slip', 3, 'incremental-slip')
    unset logscale x; set autoscale y
    set title 'Creep of a bed shaken sideways'; set xlabel 'seed'; set ylabel 'mean way a period / diameter, 10^{-4}'; set key inside top left; set yrange [0:8]; set xrange [0:9]
    plot of('creep under sideways shaking (arms to the plane)') using 1:($2*1e4) with points pt 7 ps 0.9 lc rgb colour(1) title 'arms to the plane', of('creep under sideways shaking (arms of the radius)') using 1:($2*1e4) with points pt 5 ps 0.9 lc rgb colour(2) title 'arms of the radius'
    set autoscale
    set logscale x; set format x '%g'; set key inside top left
    set title 'Detachment, column of 8 on a plate'; set xlabel 'time of a contact / time between impacts'; set ylabel 'energy after / before'
    eval "plot ".one('detachment by Walton-Braun', 1, 'Walton-Braun').", of('detachment by dashpot') ".measured(2)." title 'dashpot'"
    unset logscale x; set format x '%g'
    set key inside top left
    set title 'Column of 10 grains on a shaken plate'; set xtics 0.05; set xlabel 'frequency x layers x (m/K)^{1/2}'; set ylabel 'way of the top / of the plate'
    eval "plot ".one('soft column', 1, 'elastic')
    set xtics autofreq
    set logscale; set format '%g'
    set title 'Plate that turns during the impact'; set xlabel 'frequency x time of a contact'; set ylabel 'rebound, error / speed'; set key inside bottom right
    eval "plot ".one('drive as fast as a contact', 1, 'elastic ball')
    set title 'Ball on a spring on a shaken plate'; set xlabel 'steps a period'; set ylabel 'error / amplitude'; set key inside top right; set format x '%g'
    eval "plot ".one('walls in a step', 1, 'line: second order')
    set title 'Bead at rest: rounding of its position'; set xlabel 'stiffness, N/m'; set ylabel 'error of the force'; set key inside bottom right; set xtics 1e4; set format x '%g'
    eval "plot ".one('rounding in single precision', 1, 'single').", ".one('rounding in double precision', 2, 'double')
    unset multiplot; set xtics autofreq
    unset title; unset logscale; set autoscale; set format '%g'; unset ylabel; set key default; set grid; set xtics mirror; set ytics mirror; set mxtics default; set mytics default
}
)gp";
}

}  // namespace grainreel
