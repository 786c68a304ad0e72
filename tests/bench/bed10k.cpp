// The peers' bed in this engine: 10,125 grains, spring-dashpot with friction history, in three phases.
//   ninja -C build/release bed10k && build/release/tests/bed10k FILE [threads] [settle steps] [steps]
// FILE is a LAMMPS data file (id type diameter density x y z); lengths in m. Prints particle-steps/s a phase.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>

#include "engine/measure/energy.hpp"
#include "engine/step/step_loop.hpp"

using namespace grainreel;

namespace {

Grains read_bed(const char* path) {
    std::ifstream in(path);
    for (std::string word; in >> word && word != "Atoms";) {
    }
    Grains grains;
    int id = 0, type = 0;
    for (double d, density, x, y, z; in >> id >> type >> d >> density >> x >> y >> z;) {
        grains.add(id - 1, type - 1, Vec3(x - 0.01, y - 0.01, z), d / 2, density);
    }
    return grains;
}

// kn 1000 N/m, kt 285.7 N/m, gamma_n 2634 1/s, gamma_t 1317 1/s, mu 0.5, walls the same; step 2e-6 s.
Plan bed_plan() {
    PairPlan pair;
    pair.loading_stiffness = pair.unloading_stiffness = 1000;
    pair.tangential_stiffness = 285.7;
    pair.normal_damping = 2634;
    pair.tangential_damping = 1317;
    pair.friction = 0.5;
    pair.attraction = true;
    pair.model = {NormalForce::spring_dashpot, TangentialLaw::linear_spring, false};
    Plan plan;
    plan.grain.assign(4, pair);
    plan.wall.assign(2, pair);
    plan.clock.step = 2e-6;
    plan.clock.steps_per_period = 20000;
    plan.clock.initial_phase = 0.75;  // with no ramp: a (1 - cos wt), as LAMMPS wiggles
    return plan;
}

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return fmt::print(stderr, "usage: bed10k FILE [threads] [settle steps] [steps]\n"), 2;
    const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
    const std::int64_t settle = argc > 3 ? std::atoll(argv[3]) : 60000,
                       steps = argc > 4 ? std::atoll(argv[4]) : 20000;
    Container box;
    box.shape = Container::Shape::box;
    box.half_width = 0.01;
    box.depth = 0.02;
    box.height = 0.2;
    box.lid = false;
    Drive drive;
    drive.present = true;
    drive.frequency = 25;
    drive.amplitude = 1.19e-3;
    drive.phase = 0.75;
    drive.ramp = 0;
    drive.moves = Drive::Moves::floor;
    const Plan plan = bed_plan();
    Surroundings around;
    around.faces = container_faces(box, drive);
    around.motion = WallMotion(drive, plan.clock);
    around.gravity = {0, 0, -9.81};
    around.skin = 0.0002;
    Grains grains = read_bed(argv[1]);
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
