// The peers' bed in this engine: 10,125 grains, spring-dashpot with friction history, in three phases.
//   ninja -C build/release bed10k && build/release/tests/bed10k [threads] [settle steps] [steps] [mixed]
// Prints particle-steps/s a phase.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>

#include "engine/bench/peers_bed.hpp"
#include "engine/measure/energy.hpp"
#include "engine/step/step_loop.hpp"

using namespace grainreel;

namespace {

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
    const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
    const std::int64_t settle = argc > 2 ? std::atoll(argv[2]) : 60000,
                       steps = argc > 3 ? std::atoll(argv[3]) : 20000;
    Plan plan = peers_plan();
    if (argc > 4 && std::string(argv[4]) == "mixed") {
        for (PairPlan& pair : plan.grain) pair.model.precision = Precision::mixed;
        for (PairPlan& pair : plan.wall) pair.model.precision = Precision::mixed;
    }
    const PeersBed bed = peers_bed();
    const Surroundings around = peers_surroundings(bed, plan);
    Grains grains = peers_grains(bed);
    Team team(threads);
    const auto loop = std::make_unique<StepLoop>(plan, around, grains, team);
    loop->restart();

    std::int64_t at = -settle;
    const auto phase = [&](const char* name, std::int64_t count) {
        const double start = seconds();
        const std::clock_t cpu_start = std::clock();
        loop->run(at, count, plan.clock.step, 0);
        const double took = seconds() - start;
        const double cpu = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
        at += count;
        std::int64_t touching = 0;  // pairs of grains; walls left out, as in LAMMPS' compute contact/atom
        loop->visit_contacts(at, [&](const ContactView& c) { touching += c.second >= 0; });
        double height = 0;
        for (const Place& p : grains.place) height += p.position.z();
        const double n = static_cast<double>(grains.size());
        fmt::print(
            "{:8s} {:7.3f} M particle-steps/s ({:.3f} M a processor second), {:.2f} listed, {:.4f} touched "
            "by a grain, mean height {:.5f} mm, "
            "kinetic {:.3g} J, {} rebuilds, {} refreshes\n",
            name, n * static_cast<double>(count) / took / 1e6, n * static_cast<double>(count) / cpu / 1e6,
            static_cast<double>(loop->listed_pairs()) / n, 2 * static_cast<double>(touching) / n,
            1e3 * height / n, kinetic_energy(grains).translation, loop->rebuilds(), loop->refreshes());
    };
    phase("settled", settle);
    phase("rising", 10000);
    phase("vibrated", steps);
    return 0;
}
