// A cooling gas against Haff (1983).
#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/validation/cooling_gas.hpp"
#include "engine/lab/chart/validation/seed_mean.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {
namespace {

std::vector<double> times(bool quick) {
    if (quick) return {0.5, 1, 2};
    return {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5};
}
const std::vector<double> stiffnesses = {1e4, 1.6e5};  // N/m
int seeds(bool quick) {
    return quick ? 1 : 5;
}

void summarise(const ChartRequest& request, const ResultTable& table) {
    std::string text = "stiffness_N_m,tau,temperature,error,haff,difference_percent\n";
    for (const double stiffness : stiffnesses) {
        for (const double time : times(request.quick)) {
            std::vector<double> values;
            for (const auto& row : table.rows())
                if (row.at(0) == number(stiffness) && row.at(2) == number(time))
                    values.push_back(std::stod(row.at(3)));
            const SeedMean is = seed_mean_of(values);
            text += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:+.1f}\n", number(stiffness), time, is.mean,
                                is.error, haff(time), 100 * (is.mean / haff(time) - 1));
        }
    }
    replace_file(request.folder / "haff.csv", text);
}

bool run(const ChartRequest& request, ChartWork& work) {
    ResultTable table(request.folder / "gas.csv", "stiffness_N_m,seed,tau,temperature", 3);
    for (const double stiffness : stiffnesses) {
        for (int seed = 1; seed <= seeds(request.quick); ++seed) {
            if (!work.next(fmt::format("cooling gas, {:g} N/m, seed {}", stiffness, seed))) return false;
            const std::vector<double> at = times(request.quick);
            if (table.has({number(stiffness), number(seed), number(at.back())})) continue;
            CoolingGas gas;
            gas.stiffness = stiffness;
            gas.seed = static_cast<std::uint64_t>(seed);
            const std::vector<double> is = cool(gas, at);
            for (std::size_t k = 0; k < at.size(); ++k)
                table.add({number(stiffness), number(seed), number(at[k]), number(is[k])});
        }
    }
    summarise(request, table);
    return true;
}

}  // namespace

const ValidationPart gas_part = {
    [](bool quick) { return stiffnesses.size() * static_cast<std::size_t>(seeds(quick)); }, run};

}  // namespace grainreel
