// A granular gas that cools.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// Haff 1983, J. Fluid Mech. 134, 401: T = T0 / (1 + t/tau)^2. With Enskog's collision rate
// w = 4 sqrt(pi) n d^2 g sqrt(T/m) and (1 - e^2) T lost in each collision, 1/tau = w0 (1 - e^2) / 6; g after
// Carnahan & Starling. Smooth grains in a box of elastic walls.
TEST(Gas, CoolsAsHaffSays) {
    const double e = 0.9, solid = 0.05, speed = 0.3, diameter = 2 * kRadius;
    const int side = 9, count = side * side * side;
    PairPlan pair = walton_braun_pair(e, 0), wall = walton_braun_pair(1, 0);
    for (PairPlan* p : {&pair, &wall}) {
        p->loading_stiffness *= 0.1, p->unloading_stiffness *= 0.1;
        p->model = {NormalForce::walton_braun_corrected, TangentialLaw::none, false};
    }
    const double touch = pi / 2 * (1 + e) * std::sqrt(sphere_mass() / 2 / pair.loading_stiffness);
    World w = make_world(pair, touch / 14, NormalForce::walton_braun_corrected, TangentialLaw::none);
    w.plan.wall = {wall};
    // Centres can be anywhere in a cube smaller by a diameter, and that is the gas's volume.
    const double free = std::cbrt(count * pi / 6 * diameter * diameter * diameter / solid);
    const double edge = free + diameter;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {0.0, 1.0}) {
            Face face;
            face.normal = (end > 0 ? -1 : 1) * Vec3::Unit(axis);
            face.point = end * edge * Vec3::Unit(axis);
            w.around.faces.push_back(face);
        }
    }
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (int k = 0; k < count; ++k) {
        const Vec3 cell(k % side, k / side % side, k / side / side);
        w.grains.add(k, 0, (cell + 0.5 * Vec3::Ones()) * edge / side, kRadius, kDensity);
        w.grains.motion.back().velocity = speed * Vec3(normal(random), normal(random), normal(random));
    }
    w.around.skin = 0.5 * kRadius;
    w.start();
    const auto temperature = [&] {
        return 2.0 / 3 * kinetic_energy(w.grains).translation / (count * sphere_mass());  // m2/s2
    };
    w.run(static_cast<std::int64_t>(0.1 / w.plan.clock.step));  // from the lattice to a gas
    const std::int64_t begin = w.step;
    const double start = temperature();
    const double density = count / (free * free * free);
    const double g = (1 - solid / 2) / std::pow(1 - solid, 3);
    // Two centres a diameter apart have less room than one: the mean of (1 - d|u_x|/L)(1 - d|u_y|/L)(..).
    const double near_walls = 1 - 1.5 * diameter / free;
    const double rate = 4 * std::sqrt(pi) * density * diameter * diameter * g * near_walls * std::sqrt(start);
    const double tau = 6 / (rate * (1 - e * e));
    for (const double times : {0.5, 1.0, 2.0}) {
        w.run(begin + static_cast<std::int64_t>(times * tau / w.plan.clock.step) - w.step);
        const double expected = start / std::pow(1 + times, 2);
        EXPECT_NEAR(temperature(), expected, 0.06 * expected) << "after " << times << " tau";
        std::printf("[ measured ] T / Haff's = %.3f after %.1f tau\n", temperature() / expected, times);
    }
}

}  // namespace
}  // namespace grainreel
