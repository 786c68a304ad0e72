#include "engine/lab/chart/validation/silo.hpp"

#include <fmt/format.h>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/random.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/lab/chart/validation/validation.hpp"
#include "engine/measure/energy.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

constexpr double kDiameter = 0.004, kRadius = kDiameter / 2, kDensity = bench_density;  // m, m, kg/m3
constexpr double kGravity = 9.81, kStiffness = 2e3;                                     // m/s2, N/m
constexpr double kLoose = 0.5, kExpected = 0.58;                                        // solid fractions
constexpr double kSinking = 0.05, kWay = 0.5 * kDiameter;  // of the floor: speed in sqrt(g d), and m

double mass() {
    return kDensity * sphere_volume(kRadius);
}

double step_length() {
    return 0.1 * std::sqrt(mass() / kStiffness);
}

struct Cylinder {
    double bore;  // m

    explicit Cylinder(const SiloColumn& column) : bore(column.bore * kDiameter) {}
    double area() const { return pi / 4 * bore * bore; }
    int grains(double height) const {
        return static_cast<int>(kExpected * area() * height / sphere_volume(kRadius));
    }
    // Adds the floor, then the wall. So the floor has number 0 and the wall 1.
    void surround(SmallWorld& world) const {
        world.add_plane(Vec3(0, 0, 0), Vec3(0, 0, 1));
        Face wall;
        wall.kind = Face::Kind::cylinder;
        wall.radius = bore / 2;
        world.around.faces.push_back(wall);
        world.around.skin = 0.3 * kDiameter;
    }
};

// A loose crowd: grains at random centres, pushed apart without friction or gravity under a lid.
Grains crowd(const Cylinder& cylinder, int grains, std::uint64_t seed) {
    SmallWorld world(latching_pair(kStiffness, 1), step_length());
    cylinder.surround(world);
    const double height = grains * sphere_volume(kRadius) / (kLoose * cylinder.area());
    world.add_plane(Vec3(0, 0, height), Vec3(0, 0, -1));
    Random random(seed, Stream::centres);
    for (int k = 0; k < grains; ++k) {
        const double out = (cylinder.bore / 2 - kRadius) * std::sqrt(random.uniform());
        const double angle = random.between(0, 2 * pi), z = random.between(kRadius, height - kRadius);
        world.add(Vec3(out * math::cos(angle), out * math::sin(angle), z), Vec3::Zero(), {kRadius, kDensity});
    }
    world.start();
    const double drag = 0.5 * std::sqrt(kStiffness / mass());
    for (int look = 0; look < 100; ++look) {
        world.run(200, drag);
        if (summarise_contacts(*world.loop, world.step).largest_overlap < 1e-3) break;
    }
    return world.grains;
}

// Runs until the mean kinetic energy of a grain is below 1e-6 m g d. All of these steps lie before step 0, at
// which the floor begins to move.
void settle(SmallWorld& world) {
    constexpr double drag = 20;  // 1/s
    constexpr std::int64_t steps_per_look = 1000, most = 100 * steps_per_look;
    const double rest = 1e-6 * mass() * kGravity * kDiameter * static_cast<double>(world.grains.size());
    for (world.step = -most; world.step < 0;) {
        world.run(steps_per_look, drag);
        if (kinetic_energy(world.grains).translation < rest) break;
    }
    world.step = 0;  // the loop takes the jump for a long flight of the grains and makes its lists again
}

// Sums over the contacts with floor and wall; vertical stress is computed from grains and wall.
struct Sums {
    double floor = 0;   // N, down
    double wall = 0;    // N, normal
    double lift = 0;    // N, up, on the grains
    double moment = 0;  // N m, of weights and lifts about the floor: vertical stress summed over height
    double height = 0;  // m
    double samples = 0;

    void add(const SmallWorld& world) {
        const double level = world.around.faces[0].displacement(world.around.motion.at(world.step)).z();
        double z = 0;
        for (const Place& p : world.grains.place) z += p.position.z() - level;
        moment += mass() * kGravity * z;
        world.loop->visit_contacts(world.step, [&](const ContactView& c) {
            if (c.second == -1) floor += c.normal_force;
            if (c.second != -2) return;
            wall += c.normal_force;
            lift -= c.tangential.z();
            moment += c.tangential.z() * (c.point.z() - level);
        });
        height += 2 * z / static_cast<double>(world.grains.size());
        samples += 1;
    }
};

}  // namespace

SiloLoad load_of(const SiloColumn& column) {
    const Cylinder cylinder(column);
    const int grains = cylinder.grains(column.aspect * cylinder.bore);
    SmallWorld world(latching_pair(kStiffness, 0.7, column.friction, column.precision), step_length());
    world.plan.wall = {latching_pair(kStiffness, 0.7, column.wall_friction, column.precision)};
    cylinder.surround(world);
    world.grains = crowd(cylinder, grains, column.seed);
    for (Motion& m : world.grains.motion) m.velocity.setZero();
    const double speed = kSinking * std::sqrt(kGravity * kDiameter);
    world.around.faces[0].body.velocity = Vec3(0, 0, -speed);
    world.around.motion = DriveMotion(Drive(), world.plan.clock);
    world.around.gravity = Vec3(0, 0, -kGravity);
    world.start();
    settle(world);
    Sums resting, sums;
    resting.add(world);
    const auto steps = static_cast<std::int64_t>(kWay / speed / world.plan.clock.step);
    while (world.step < steps) {
        world.run(50);
        if (world.step > steps / 2) sums.add(world);
    }
    const double weight = grains * mass() * kGravity, height = sums.height / sums.samples;
    SiloLoad load;
    load.solid_fraction = grains * sphere_volume(kRadius) / (cylinder.area() * height);
    load.filling = height / cylinder.bore;
    load.apparent = load.filling * sums.floor / sums.samples / weight;
    load.resting = load.filling * resting.floor / weight;
    load.stress_ratio = sums.wall / (pi * cylinder.bore) / (sums.moment / cylinder.area());
    load.mobilised = sums.lift / (column.wall_friction * sums.wall);
    return load;
}

double janssen(double filling, double friction_times_ratio) {
    return (1 - math::exp(-4 * friction_times_ratio * filling)) / (4 * friction_times_ratio);
}

JanssenFit fit_janssen(const std::vector<SiloLoad>& loads) {
    const auto rms = [&](double product) {
        double sum = 0;
        for (const SiloLoad& l : loads) sum += math::square(l.apparent - janssen(l.filling, product));
        return std::sqrt(sum / static_cast<double>(loads.size()));
    };
    double low = 1e-3, high = 3;  // for the golden section; the rms has one minimum
    const double share = (std::sqrt(5.0) - 1) / 2;
    while (high - low > 1e-7) {
        const double a = high - share * (high - low), b = low + share * (high - low);
        (rms(a) < rms(b) ? high : low) = rms(a) < rms(b) ? b : a;
    }
    return {low, rms(low) * 4 * low};
}

// The comparison of columns in a cylinder with Janssen's law (1895).

namespace {

// The two walls of the comparison: grains slide along one, and roll along the other, which is as rough as the
// grains.
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

struct WallLoad {
    double aspect;
    SiloLoad load;
};
std::vector<WallLoad> loads_in(const ResultTable& table, double friction) {
    std::vector<WallLoad> loads;
    for (const auto& row : table.rows()) {
        const auto value = [&](std::size_t k) { return value_in(row, k); };
        if (row.at(0) != number(friction)) continue;
        loads.push_back({value(1), {value(3), value(4), value(5), value(6), value(7), value(8)}});
    }
    return loads;
}

// One row for a wall: the K that fits, and the K that follows from the forces.
std::string fit_row(double friction, const std::vector<WallLoad>& loaded) {
    std::vector<SiloLoad> loads;
    std::vector<double> ratio, mobilised, product;
    for (const WallLoad& l : loaded) {
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

// Rows of one wall, one for each height: the mean over the seeds beside the law with that K.
std::string height_rows(double friction, const std::vector<WallLoad>& loaded, bool quick) {
    std::vector<SiloLoad> all;
    for (const WallLoad& l : loaded) all.push_back(l.load);
    const double product = fit_janssen(all).friction_times_ratio;
    std::string rows;
    for (const double aspect : aspects(quick)) {
        std::vector<double> filling, ours, resting;
        for (const WallLoad& l : loaded) {
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

void summarise_silos(const ChartRequest& request, const ResultTable& table) {
    std::string fits =
        "wall_friction,K_fitted,rms_over_saturation,K_from_forces,error,mobilised,error,product,error\n";
    std::string heights = "wall_friction,filling,ours,error,janssen,difference_percent,resting\n";
    for (const Wall& wall : walls(request.quick)) {
        const std::vector<WallLoad> loads = loads_in(table, wall.friction);
        fits += fit_row(wall.friction, loads);
        heights += height_rows(wall.friction, loads, request.quick);
    }
    replace_file(request.folder / "janssen_fit.csv", fits);
    replace_file(request.folder / "janssen.csv", heights);
}

bool run_silos(const ChartRequest& request, ChartWork& work) {
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
    summarise_silos(request, table);
    return true;
}

std::size_t pieces(bool quick) {
    std::size_t sum = 0;
    for (const Wall& wall : walls(quick)) sum += aspects(quick).size() * static_cast<std::size_t>(wall.seeds);
    return sum;
}

}  // namespace

const ValidationPart silo_part = {pieces, run_silos};

}  // namespace grainreel
