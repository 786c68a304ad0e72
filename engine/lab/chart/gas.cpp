#include "engine/lab/chart/gas.hpp"

#include <cmath>

#include "engine/base/random.hpp"
#include "engine/measure/energy/energy.hpp"

namespace grainreel {

double GasInCube::free() const {
    return std::cbrt(count() * sphere_volume(bench_radius) / solid_fraction);
}

Gas::Gas(const Plan& plan, const GasInCube& in) : cube(in), bench(plan, 0.5 * bench_radius) {
    const double edge = cube.edge();
    for (int axis = 0; axis < 3; ++axis) {
        bench.add_plane(Vec3(0, 0, 0), Vec3::Unit(axis));
        bench.add_plane(edge * Vec3::Unit(axis), -Vec3::Unit(axis));
    }
    Random random(cube.seed, Stream::velocities);
    for (int k = 0; k < cube.count(); ++k) {
        const Vec3 cell(k % cube.side, k / cube.side % cube.side, k / cube.side / cube.side);
        const double u = random.normal(), v = random.normal(), w = random.normal();
        bench.add((cell + 0.5 * Vec3::Ones()) * edge / cube.side, cube.speed * Vec3(u, v, w));
    }
    bench.start();
}

double Gas::temperature() const {
    return 2.0 / 3 * kinetic_energy(bench.grains).translation / (cube.count() * bench_mass());
}

double Gas::energy() const {
    return bench.kinetic() + summarise_contacts(*bench.loop, bench.step).stored;
}

void Gas::run_to(double seconds) {
    bench.run(static_cast<std::int64_t>(seconds / bench.plan.clock.step) - bench.step);
}

}  // namespace grainreel
