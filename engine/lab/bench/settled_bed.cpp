#include "engine/lab/bench/settled_bed.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/team.hpp"
#include "engine/lab/bench/bench_case.hpp"
#include "engine/lab/bench/peers_bed.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {
namespace {

constexpr int kOneBed = 10125, kBigOnes = 1125;
constexpr double kSofter = 16;       // springs; the heap's own weight presses grains in by less than 1 %
constexpr double kTime = 0.16;       // s
constexpr std::int64_t kLook = 500;  // steps

Plan soft_plan() {
    Plan plan = peers_plan();
    for (auto* kinds : {&plan.grain, &plan.wall})
        for (PairPlan& pair : *kinds) {
            pair.loading_stiffness /= kSofter;
            pair.unloading_stiffness /= kSofter;
            pair.tangential_stiffness /= kSofter;
            pair.normal_damping /= std::sqrt(kSofter);
            pair.tangential_damping /= std::sqrt(kSofter);
        }
    plan.clock.step *= std::sqrt(kSofter);
    return plan;
}

}  // namespace

SettledBed settled_bed(int grains, int threads, const std::function<bool(double)>& watcher) {
    const int count = std::min(grains, kOneBed), big = count * kBigOnes / kOneBed;
    SettledBed settled;
    settled.side = 0.02 * std::sqrt(count / static_cast<double>(kOneBed));
    const PeersBed start = peers_bed(7, count - big, big, settled.side);
    const Plan plan = soft_plan();
    Surroundings around = peers_surroundings(start, plan);
    around.motion = WallMotion(Drive{}, plan.clock);
    BenchBed bed{plan, around, peers_grains(start)};
    Team team(threads);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    loop.restart();
    const auto steps = static_cast<std::int64_t>(kTime / plan.clock.step);
    for (std::int64_t step = 0; step < steps; step += kLook) {
        if (!watcher(static_cast<double>(step) / static_cast<double>(steps))) return {};
        loop.run(step, kLook, plan.clock.step, 0);
    }
    const int k =
        static_cast<int>(std::lround(std::sqrt(std::max(1.0, grains / static_cast<double>(kOneBed)))));
    settled.grains = k > 1 ? copied(bed, bed.grains, settled.side, k).grains : bed.grains;
    settled.side *= k;
    for (const Place& place : settled.grains.place)
        settled.height = std::max(settled.height, place.position.z() + place.radius);
    return settled;
}

}  // namespace grainreel
