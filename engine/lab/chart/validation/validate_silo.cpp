// Columns in a cylinder against Janssen (1895).
#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/validation/seed_mean.hpp"
#include "engine/lab/chart/validation/silo.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {
namespace {

// A wall that grains slide along, and one as rough as they are, where they roll.
struct Wall {
    double friction;
    int seeds;
};
std::vector<Wall> walls(bool quick) {
    if (quick) return {{0.2, 1}, {0.5, 1}};
    return {{0.2, 3}, {0.5, 1}};
}
std::vector<double> aspects(bool quick) {
    if (quick) return {0.5, 1.5};
    return {0.25, 0.5, 1, 1.5, 2, 3, 4};
}

struct Loaded {
    double aspect;
    SiloLoad load;
};
std::vector<Loaded> loads_in(const ResultTable& table, double friction) {
    std::vector<Loaded> loads;
    for (const auto& row : table.rows()) {
        const auto value = [&](std::size_t k) { return std::stod(row.at(k)); };
        if (row.at(0) != number(friction)) continue;
        loads.push_back({value(1), {value(3), value(4), value(5), value(6), value(7), value(8)}});
    }
    return loads;
}

// One row a wall: the K that fits, and what the forces say it is.
std::string fit_row(double friction, const std::vector<Loaded>& loaded) {
    std::vector<SiloLoad> loads;
    std::vector<double> ratio, mobilised, product;
    for (const Loaded& l : loaded) {
        loads.push_back(l.load);
        ratio.push_back(l.load.stress_ratio), mobilised.push_back(l.load.mobilised);
        product.push_back(l.load.stress_ratio * l.load.mobilised);
    }
    const JanssenFit fit = fit_janssen(loads);
    const SeedMean a = seed_mean_of(ratio), b = seed_mean_of(mobilised), c = seed_mean_of(product);
    return fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", friction,
                       fit.friction_times_ratio / friction, fit.residual, a.mean, a.error, b.mean, b.error,
                       c.mean, c.error);
}

// One row a height: the mean over the seeds beside the law with that K.
std::string height_rows(double friction, const std::vector<Loaded>& loaded, bool quick) {
    std::vector<SiloLoad> all;
    for (const Loaded& l : loaded) all.push_back(l.load);
    const double product = fit_janssen(all).friction_times_ratio;
    std::string rows;
    for (const double aspect : aspects(quick)) {
        std::vector<double> filling, ours, resting;
        for (const Loaded& l : loaded) {
            if (l.aspect != aspect) continue;
            filling.push_back(l.load.filling), ours.push_back(l.load.apparent);
            resting.push_back(l.load.resting);
        }
        const double at = seed_mean_of(filling).mean, should = janssen(at, product);
        const SeedMean is = seed_mean_of(ours);
        rows += fmt::format("{},{:.3f},{:.4f},{:.4f},{:.4f},{:+.1f},{:.4f}\n", friction, at, is.mean,
                            is.error, should, 100 * (is.mean / should - 1), seed_mean_of(resting).mean);
    }
    return rows;
}

void summarise(const ChartRequest& request, const ResultTable& table) {
    std::string fits =
        "wall_friction,K_fitted,rms_over_saturation,K_from_forces,error,mobilised,error,product,error\n";
    std::string heights = "wall_friction,filling,ours,error,janssen,difference_percent,resting\n";
    for (const Wall& wall : walls(request.quick)) {
        const std::vector<Loaded> loads = loads_in(table, wall.friction);
        fits += fit_row(wall.friction, loads);
        heights += height_rows(wall.friction, loads, request.quick);
    }
    replace_file(request.folder / "janssen_fit.csv", fits);
    replace_file(request.folder / "janssen.csv", heights);
}

bool run(const ChartRequest& request, ChartWork& work) {
    ResultTable table(
        request.folder / "silo.csv",
        "wall_friction,aspect,seed,filling,apparent,solid_fraction,stress_ratio,mobilised,resting", 3);
    for (const Wall& wall : walls(request.quick)) {
        for (int seed = 1; seed <= wall.seeds; ++seed) {
            for (const double aspect : aspects(request.quick)) {
                if (!work.next(fmt::format("silo, wall friction {}, {} bores high, seed {}", wall.friction,
                                           aspect, seed)))
                    return false;
                if (table.has({number(wall.friction), number(aspect), number(seed)})) continue;
                const SiloLoad l = load_of({request.quick ? 8.0 : 10.0, aspect, 0.5, wall.friction,
                                            static_cast<std::uint64_t>(seed)});
                table.add({number(wall.friction), number(aspect), number(seed), number(l.filling),
                           number(l.apparent), number(l.solid_fraction), number(l.stress_ratio),
                           number(l.mobilised), number(l.resting)});
            }
        }
    }
    summarise(request, table);
    return true;
}

std::size_t pieces(bool quick) {
    std::size_t sum = 0;
    for (const Wall& wall : walls(quick)) sum += aspects(quick).size() * static_cast<std::size_t>(wall.seeds);
    return sum;
}

}  // namespace

const ValidationPart silo_part = {pieces, run};

}  // namespace grainreel
