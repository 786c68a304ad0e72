// Jammed packings against O'Hern et al. (2003), Silbert (2010) and Onoda & Liniger (1990).
#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/validation/packing.hpp"
#include "engine/lab/chart/validation/seed_mean.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {
namespace {

const std::vector<double> frictions = {0, 0.1, 0.5, 10};
int seeds(bool quick) {
    return quick ? 1 : 3;
}

// Without friction larger, for there the figures are sharp.
JammedPacking packing_of(double friction, int seed, bool quick) {
    JammedPacking packing;
    packing.friction = friction;
    packing.grains = quick ? 1500 : friction > 0 ? 3000 : 6000;
    packing.margin = quick ? 2.5 : friction > 0 ? 3 : 4;
    packing.share = friction > 0 ? 0.25 : 0.4;
    packing.seed = static_cast<std::uint64_t>(seed);
    return packing;
}

int states_of(double friction, bool quick) {
    return quick ? 10 : friction > 0 ? 20 : 12;
}

std::vector<PackingState> states_in(const ResultTable& table, double friction, int seed) {
    std::vector<PackingState> states;
    for (const auto& row : table.rows()) {
        if (row.at(0) != number(friction) || row.at(1) != number(seed) || row.at(2) == "end") continue;
        states.push_back({std::stod(row.at(3)), std::stod(row.at(4)), std::stod(row.at(5)),
                          std::stod(row.at(6)), std::stod(row.at(7))});
    }
    return states;
}

void summarise(const ChartRequest& request, const ResultTable& table) {
    std::string text = "friction,seeds,solid_fraction,error,contacts,error,rise,error\n";
    for (const double friction : frictions) {
        std::vector<double> solid, contacts, rise;
        for (int seed = 1; seed <= seeds(request.quick); ++seed) {
            const JammingPoint point = jamming_point(states_in(table, friction, seed));
            solid.push_back(point.solid_fraction), contacts.push_back(point.contacts);
            rise.push_back(point.rise);
        }
        const SeedMean a = seed_mean_of(solid), b = seed_mean_of(contacts), c = seed_mean_of(rise);
        text += fmt::format("{},{},{:.4f},{:.4f},{:.3f},{:.3f},{:.2f},{:.2f}\n", friction, solid.size(),
                            a.mean, a.error, b.mean, b.error, c.mean, c.error);
    }
    replace_file(request.folder / "jamming.csv", text);
}

bool run(const ChartRequest& request, ChartWork& work) {
    ResultTable table(request.folder / "packing.csv",
                      "friction,seed,state,pressure_d_K,solid_fraction,contacts,rattlers,unbalanced", 3);
    for (const double friction : frictions) {
        for (int seed = 1; seed <= seeds(request.quick); ++seed) {
            if (!work.next(fmt::format("packing, friction {}, seed {}", friction, seed))) return false;
            if (table.has({number(friction), number(seed), "end"})) continue;
            const auto states =
                decompress(packing_of(friction, seed, request.quick), states_of(friction, request.quick));
            for (std::size_t k = 0; k < states.size(); ++k) {
                const PackingState& s = states[k];
                const std::vector<std::string> key = {number(friction), number(seed),
                                                      number(static_cast<double>(k))};
                if (table.has(key)) continue;
                table.add({key[0], key[1], key[2], number(s.pressure), number(s.solid_fraction),
                           number(s.contacts), number(s.rattlers), number(s.unbalanced)});
            }
            table.add({number(friction), number(seed), "end", "", "", "", "", ""});
        }
    }
    summarise(request, table);
    return true;
}

}  // namespace

const ValidationPart packing_part = {
    [](bool quick) { return frictions.size() * static_cast<std::size_t>(seeds(quick)); }, run};

}  // namespace grainreel
