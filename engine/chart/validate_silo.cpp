// Columns in a cylinder against Janssen (1895).
#include <fmt/format.h>

#include "engine/base/text_file.hpp"
#include "engine/chart/result_table.hpp"
#include "engine/chart/silo.hpp"
#include "engine/chart/validation.hpp"

namespace grainreel {
namespace {

std::vector<double> aspects(bool quick) {
    if (quick) return {0.5, 1.5};
    return {0.25, 0.5, 1, 1.5, 2, 3, 4};
}
int seeds(bool quick) {
    return quick ? 1 : 3;
}

SiloColumn column_of(double aspect, int seed, bool quick) {
    SiloColumn column;
    column.bore = quick ? 8 : 10;
    column.aspect = aspect;
    column.seed = static_cast<std::uint64_t>(seed);
    return column;
}

void summarise(const ChartRequest& request, const ResultTable& table) {
    std::vector<SiloLoad> loads;
    std::vector<double> ratio, mobilised, product;
    for (const auto& row : table.rows()) {
        const auto value = [&](std::size_t k) { return std::stod(row.at(k)); };
        loads.push_back({value(2), value(3), value(4), value(5), value(6), value(7)});
        ratio.push_back(loads.back().stress_ratio), mobilised.push_back(loads.back().mobilised);
        product.push_back(ratio.back() * mobilised.back());
    }
    const double friction = SiloColumn().wall_friction;
    const JanssenFit fit = fit_janssen(loads);
    std::string text = "quantity,value,error\n";
    text += fmt::format("wall friction,{},\n", friction);
    text += fmt::format("K fitted,{:.4f},\n", fit.friction_times_ratio / friction);
    text += fmt::format("rms over saturation mass,{:.4f},\n", fit.residual);
    const auto add = [&](const char* what, const std::vector<double>& values) {
        const SeedMean mean = mean_of(values);
        text += fmt::format("{},{:.4f},{:.4f}\n", what, mean.mean, mean.error);
    };
    add("K from forces", ratio);
    add("share of friction mobilised", mobilised);
    add("K from forces times share", product);
    replace_file(request.folder / "janssen_fit.csv", text);
    std::string rows = "filling,ours,janssen,difference_percent,resting\n";
    for (const double aspect : aspects(request.quick)) {
        std::vector<double> filling, ours, resting;
        for (const auto& row : table.rows()) {
            if (row.at(0) != number(aspect)) continue;
            filling.push_back(std::stod(row.at(2))), ours.push_back(std::stod(row.at(3)));
            resting.push_back(std::stod(row.at(7)));
        }
        const double at = mean_of(filling).mean, is = mean_of(ours).mean;
        const double should = janssen(at, fit.friction_times_ratio);
        rows += fmt::format("{:.3f},{:.4f},{:.4f},{:+.1f},{:.4f}\n", at, is, should, 100 * (is / should - 1),
                            mean_of(resting).mean);
    }
    replace_file(request.folder / "janssen.csv", rows);
}

bool run(const ChartRequest& request, ChartWork& work) {
    ResultTable table(request.folder / "silo.csv",
                      "aspect,seed,filling,apparent,solid_fraction,stress_ratio,mobilised,resting", 2);
    for (int seed = 1; seed <= seeds(request.quick); ++seed) {
        for (const double aspect : aspects(request.quick)) {
            if (!work.next(fmt::format("silo, {} bores high, seed {}", aspect, seed))) return false;
            if (table.has({number(aspect), number(seed)})) continue;
            const SiloLoad l = load_of(column_of(aspect, seed, request.quick));
            table.add({number(aspect), number(seed), number(l.filling), number(l.apparent),
                       number(l.solid_fraction), number(l.stress_ratio), number(l.mobilised),
                       number(l.resting)});
        }
    }
    summarise(request, table);
    return true;
}

}  // namespace

const ValidationPart silo_part = {
    [](bool quick) { return aspects(quick).size() * static_cast<std::size_t>(seeds(quick)); }, run};

}  // namespace grainreel
