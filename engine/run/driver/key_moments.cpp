#include "engine/run/driver/key_moments.hpp"
#include "engine/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

constexpr double most_bytes = 40e6;
constexpr double bytes_a_grain = 68 + 3 * 44;  // its place in one file, and three contacts in the other
constexpr int last_periods = 2, phases = 8;    // of the drive, and moments in each
constexpr int between = 12;

// What matters most comes first.
std::vector<std::int64_t> wanted_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                       const std::vector<double>& named) {
    const std::int64_t last = plan.steps;
    std::vector<std::int64_t> steps{first, last};
    for (const double time : named) steps.push_back(std::llround(time / plan.clock.step));
    if (scene.drive.present)
        for (int k = 1; k <= last_periods * phases; ++k)
            steps.push_back(plan.clock.step_at(plan.clock.cycles(last) - static_cast<double>(k) / phases));
    for (int k = 1; k < between; ++k) steps.push_back(first + (last - first) * k / between);
    return steps;
}

}  // namespace

std::set<std::int64_t> key_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                 const std::vector<double>& named) {
    std::set<std::int64_t> steps;
    const auto most = static_cast<std::size_t>(
        most_bytes / (bytes_a_grain * static_cast<double>(std::max<std::int64_t>(1, plan.capacity))));
    for (const std::int64_t step : wanted_steps(scene, plan, first, named))
        if (steps.size() < most && step >= first && step <= plan.steps) steps.insert(step);
    return steps;
}

}  // namespace grainreel
