#include "engine/lab/bench/lattice_speed.hpp"

#include <time.h>

#include <algorithm>

#include "engine/lab/chart/bench.hpp"

namespace grainreel {
namespace {

constexpr int side = 12, steps = 40, stretches = 30;
constexpr double step = 1e-9;  // s: nothing moves far, so that every stretch finds the same contacts

Plan lattice_plan() {
    Plan plan;
    PairPlan pair = latching_pair(bench_stiffness, 0.9, 0.5);
    pair.model.normal = NormalForce::walton_braun_corrected;
    plan.grain = plan.wall = {pair};
    plan.clock.step = step;
    return plan;
}

Grains lattice_grains() {
    Grains grains;
    const double apart = 2 * bench_radius * (1 - 1e-4);
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) {
                grains.add(static_cast<std::int32_t>(grains.size()), 0, apart * Vec3(x, y, z), bench_radius,
                           bench_density);
                grains.motion.back().velocity = 0.01 * Vec3(y % 2, z % 2, x % 2);
            }
    return grains;
}

// s of processor time, of all the program's threads.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double lattice_speed(int threads) {
    const Plan plan = lattice_plan();
    Surroundings around;
    around.skin = 0.2 * bench_radius;
    Grains grains = lattice_grains();
    Team team(threads);
    StepLoop loop(plan, around, grains, team);
    loop.restart();
    double best = 0;
    for (int stretch = 0; stretch < stretches; ++stretch) {
        const double begin = processor_seconds();
        loop.run(stretch * steps, steps, step, 0);
        const double taken = (processor_seconds() - begin) / threads;
        best = std::max(best, steps * static_cast<double>(side * side * side) / taken);
    }
    return best;
}

}  // namespace grainreel
