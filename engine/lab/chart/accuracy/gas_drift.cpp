#include "engine/lab/chart/accuracy/gas_drift.hpp"

#include <fmt/format.h>

#include "engine/lab/chart/accuracy/nearly_elastic_gas.hpp"

namespace grainreel {
namespace {

// With as many forces a contact as the table of single contacts has, or as the plan has it.
constexpr double forces = 12;
const GasSetting plain{"velocity Verlet", "walton-braun", {}, GasSetting::Corrected::no, forces};
const GasSetting corrected{"with corrections", "walton-braun", {}, GasSetting::Corrected::yes, forces};
const GasSetting planned{"Walton-Braun as planned"};

GasSetting with_integrator(const char* name, const char* key) {
    GasSetting setting = plain;
    setting.name = name;
    setting.sets = {std::string("run.integrator=") + key};
    return setting;
}

std::vector<GasSetting> elastic_settings() {
    return {plain,
            corrected,
            with_integrator("leapfrog", "leapfrog"),
            with_integrator("position Verlet", "position-verlet"),
            with_integrator("Forest-Ruth", "forest-ruth"),
            with_integrator("Gear", "gear"),
            {"spring-dashpot", "spring-dashpot"},
            {"Hertz", "hertz"},
            planned};
}

// Gases of one restitution, and how long they are followed, in contacts.
struct GasRun {
    GasSetting setting;
    double restitution;
    std::vector<double> times;
};
std::vector<GasRun> gas_runs(bool quick) {
    const std::vector<double> times =
        quick ? std::vector<double>{250, 500} : std::vector<double>{250, 500, 1000, 2000, 4000, 8000};
    std::vector<GasRun> all;
    for (const GasSetting& setting : elastic_settings()) all.push_back({setting, 1, times});
    const std::vector<double> nearly =
        quick ? std::vector<double>{0.9, 0.999}
              : std::vector<double>{0.9, 0.95, 0.98, 0.99, 0.995, 0.997, 0.998, 0.999, 0.9995, 0.9999};
    for (const GasSetting& setting : {plain, corrected, planned})
        for (const double e : nearly) all.push_back({setting, e, {quick ? 250.0 : 1000.0}});
    return all;
}
int seeds(bool quick) {
    return quick ? 1 : 4;
}

}  // namespace

std::size_t gas_drift_pieces(bool quick) {
    return gas_runs(quick).size() * static_cast<std::size_t>(seeds(quick));
}

bool run_gas_drift(bool quick, ResultTable& table, ChartWork& work) {
    for (const GasRun& run : gas_runs(quick)) {
        const std::string& name = run.setting.name;
        for (int seed = 1; seed <= seeds(quick); ++seed) {
            if (!work.next(fmt::format("gas, {}, e = {}, seed {}", name, run.restitution, seed)))
                return false;
            const auto key = [&](double time) {
                return std::vector<std::string>{name, number(run.restitution), number(seed), number(time)};
            };
            if (table.has(key(run.times.back()))) continue;
            const auto energies =
                gas_energy(gas_plan(run.setting, run.restitution), static_cast<std::uint64_t>(seed),
                           run.times, [&] { return work.goes_on(); });
            if (energies.empty()) return false;
            for (std::size_t k = 0; k < run.times.size(); ++k) {
                const GasEnergy& is = energies[k];
                std::vector<std::string> row = key(run.times[k]);
                if (table.has(row)) continue;
                for (const double value : {static_cast<double>(is.steps), is.gained, is.lost})
                    row.push_back(number(value));
                table.add(row);
            }
        }
    }
    return true;
}

const char* gas_drift_drawing() {
    return R"(    set output 'gas.'.form
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
)";
}

}  // namespace grainreel
