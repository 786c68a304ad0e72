// Speed against accuracy at one look: what the number of steps in a contact changes in a bed, and the picture
// that sets it beside the errors of single contacts (contacts.csv) and the other engines' own steps.
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/lab/chart/accuracy/accuracy.hpp"
#include "engine/lab/chart/small_bed.hpp"

namespace grainreel {
namespace {

struct BedLaw {
    const char* name;  // as in contacts.csv
    const char* set;
};
constexpr BedLaw laws[] = {{"with corrections", "contact.law=walton-braun"},
                           {"spring-dashpot", "contact.law=spring-dashpot"},
                           {"Hertz-Mindlin", "contact.law=hertz"}};

// The largest number is the reference of its law.
std::vector<int> numbers_of_steps(bool quick) {
    if (quick) return {8, 12, 45};
    return {6, 8, 12, 20, 45, 160};
}
int seeds(bool quick) {
    return quick ? 1 : 4;
}

}  // namespace

std::size_t bed_steps_pieces(bool quick) {
    return std::size(laws) * numbers_of_steps(quick).size() * static_cast<std::size_t>(seeds(quick));
}

bool run_bed_steps(bool quick, ResultTable& table, ChartWork& work) {
    for (int seed = 1; seed <= seeds(quick); ++seed) {
        for (const BedLaw& law : laws) {
            for (const int steps : numbers_of_steps(quick)) {
                if (!work.next(fmt::format("bed, {}, {} steps, seed {}", law.name, steps, seed)))
                    return false;
                if (table.has({law.name, number(steps), number(seed)})) continue;
                const BedSetting setting{law.name, {law.set, fmt::format("run.steps_per_contact={}", steps)}};
                try {
                    const auto r = run_bed(setting, static_cast<std::uint64_t>(seed), quick ? 0.5 : 2.0,
                                           [&] { return work.goes_on(); });
                    if (!r) return false;
                    table.add({law.name, number(steps), number(seed), number(r->height),
                               number(r->temperature), number(r->contacts), number(r->mixing)});
                } catch (const RunError&) {  // a run that the health check stopped is a result too
                    table.add({law.name, number(steps), number(seed), "nan", "nan", "nan", "nan"});
                }
            }
        }
    }
    return true;
}

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
    # Mean over the seeds of a column of steps.csv, less that with most steps, in per cent; and its error.
    bed(m, column) = sprintf("< awk -F, '$1==\"%s\" {n[$2]++; s[$2]+=$%d; q[$2]+=$%d^2; if ($2+0>top) top=$2+0} END {r=s[top]/n[top]; for (k in n) if (k<top) {m=s[k]/n[k]; v=(q[k]/n[k]-m^2)/(n[k]>1?n[k]-1:1); print k\",\"100*(m/r-1)\",\"100*sqrt(v>0?v:0)/r*sqrt(2)}}' steps.csv | sort -g", m, column, column)
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
    set xlabel 'cost of a contact, ns of one thread (forces in a contact x time of one force)'
    set ylabel 'difference, %'
    set title "Mean height of a shaken bed, against 160 steps a contact"
    set yrange [-4:4]
    plot for [k=1:3] bed(word(shown,k), 4) using ($1*cost(word(shown,k))):2:3 with yerrorlines lw 2 pt 6 ps 0.7 lc rgb colour(k) notitle, 0 lc 'gray50' lw 1 notitle
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
