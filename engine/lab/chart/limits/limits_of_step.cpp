// The longest stable step: elastic grains at rest in contact are disturbed a little. Above the limit the
// disturbance grows without end. Verlet's limit is 2 / omega of the fastest mode (Allen & Tildesley); that
// of a dense bed is well below that of a pair (O'Sullivan & Bray 2004, Eng. Comput. 21, 278).

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/random.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {

namespace {

constexpr double kOverlap = 1e-3 * bench_radius;

// sqrt(m / K) in s, the unit of all steps here.
double unit() {
    return std::sqrt(bench_mass() / bench_stiffness);
}

PairPlan spring(double restitution, double friction, double tangential_ratio) {
    PairPlan pair = latching_pair(bench_stiffness, restitution, friction);
    if (friction > 0) pair.model.tangential = TangentialLaw::linear_spring;
    pair.tangential_stiffness = tangential_ratio * bench_stiffness;
    return pair;
}

struct Disturbance {
    Vec3 along;  // directions in which velocities are disturbed
    int steps;   // number of steps in which an unstable disturbance grows ten-thousandfold
};

// Factor by which the amplitude grows in a step; 1 for no growth. It is measured from where the energy has
// become 1e4 times that at the start. If the energy never becomes 1e8 times as large, the factor is the mean
// over all steps.
double growth_of(SmallWorld& world, const Disturbance& disturbance) {
    Random random(1, Stream::centres);
    const double speed = 1e-9 * kOverlap / unit();
    for (Motion& motion : world.grains.motion)
        for (int axis = 0; axis < 3; ++axis)
            motion.velocity[axis] = disturbance.along[axis] * random.between(-speed, speed);
    const double begin = world.kinetic();
    double from = begin, now = begin;
    std::int64_t since = 0;
    while (world.step < disturbance.steps && now < 1e12 * begin) {
        world.run(1);
        now = world.kinetic();
        if (from == begin && now > 1e4 * begin) from = now, since = world.step;
    }
    if (now < 1e8 * begin) return std::max(1.0, math::pow(now / begin, 0.5 / disturbance.steps));
    return math::pow(now / from, 0.5 / static_cast<double>(world.step - since));
}

// Finds the longest stable step, in units of sqrt(m / K), and the curve of growth against the step. The
// curve's steps are divided by the limit of theory.
template <class Build>
Finding find_limit(const Build& build, const Disturbance& disturbance, double theory,
                   Integrator integrator = Integrator::velocity_verlet) {
    constexpr double coarse = 0.05;
    // Below the limit Verlet's amplitude swings, but it does not grow by this factor.
    const double unstable = math::pow(1e4, 1.0 / disturbance.steps);
    const auto growth = [&](double share) { return growth_of(*build(share * theory * unit()), disturbance); };
    Finding finding;
    finding.theory = theory;
    finding.usual = usual_step() / unit();
    double stable = kUnknown;
    for (double share = 0.5; share < 1.3; share += coarse) {
        const double grown = growth(share);
        finding.curve.push_back(
            {share, grown, std::max(1.0, growth_a_step(integrator, share * stability_limit(integrator)))});
        if (grown >= unstable && std::isnan(stable)) stable = share - coarse;
    }
    if (std::isnan(stable)) return finding;
    finding.measured = theory * last_that_holds(stable, stable + coarse, 8,
                                                [&](double share) { return growth(share) < unstable; });
    return finding;
}

const Disturbance along_z{{0, 0, 1}, 2000};

// Grains one above the other between two plates, all pressed together by the same force.
std::unique_ptr<SmallWorld> column(int count, double plate_stiffness, double step, Integrator integrator) {
    auto whole = std::make_unique<SmallWorld>(spring(1, 0, 0), step, integrator);
    SmallWorld& world = *whole;
    world.plan.wall[0].loading_stiffness = world.plan.wall[0].unloading_stiffness = plate_stiffness;
    const double at_plate = kOverlap * bench_stiffness / plate_stiffness;
    double z = bench_radius - at_plate;
    world.add_floor();
    for (int k = 0; k < count; ++k) {
        world.add(Vec3(0, 0, z));
        z += 2 * bench_radius - kOverlap;
    }
    world.add_plane(Vec3(0, 0, z - bench_radius + kOverlap - at_plate), Vec3(0, 0, -1));
    world.start();
    return whole;
}

// Two grains between soft plates: omega^2 = (2 K + K_plate) / m.
Experiment pair_limit(Integrator integrator) {
    constexpr double plate = 0.01;  // stiffness of the plates divided by K
    return {"step: pair by " + word_of(integrator, integrator_words), "step / sqrt(m/K)", Failing::loud,
            "health check; the plan's step; check warns above the stable limit", [=](bool) {
                return find_limit(
                    [&](double step) { return column(2, plate * bench_stiffness, step, integrator); },
                    along_z, stability_limit(integrator) / std::sqrt(2 + plate), integrator);
            }};
}

// A chain of grains between plates as stiff as the grains: omega = 2 sqrt(K/m) cos(pi / (2 (n + 1))).
Finding chain_limit(bool) {
    constexpr int count = 20;
    const double theory = 1 / math::cos(std::numbers::pi / (2 * (count + 1)));
    return find_limit(
        [](double step) { return column(count, bench_stiffness, step, Integrator::velocity_verlet); },
        along_z, theory);
}

// A contact that was unloaded to a force below its peak swings with the unloading stiffness K2: omega^2 =
// 2 K2 / m for the pair.
Finding unloading_limit(bool) {
    constexpr double e = 0.5, plate = 0.01;
    const auto build = [](double step) {
        auto whole = column(2, plate * bench_stiffness, step, Integrator::velocity_verlet);
        SmallWorld& world = *whole;
        world.plan.grain = {spring(e, 0, 0)};
        world.start();  // now the contact has had the overlap `overlap`
        const double back = 0.5 * e * e * kOverlap, less = 0.5 * kOverlap / plate;  // halve the force
        const std::size_t low = world.at(0), high = world.at(1);
        world.grains.place[high].position.z() += back;
        for (Face& face : world.around.faces) face.point.z() -= face.normal.z() * less;
        world.around.faces[1].point.z() += back;
        world.grains.load[low] = world.grains.load[high] = {};
        return whole;
    };
    return find_limit(build, along_z, 2 / std::sqrt(2 / (e * e) + plate));
}

// A ball on a floor with friction: its slip s follows s'' = -3.5 K0/m s.
Finding sideways_limit(bool) {
    constexpr double ratio = 0.8;
    const auto build = [](double step) {
        auto whole = std::make_unique<SmallWorld>(spring(1, 1e6, ratio), step);
        SmallWorld& world = *whole;
        world.around.gravity = {0, 0, -bench_stiffness * kOverlap / bench_mass()};
        world.add_floor();
        world.add(Vec3(0, 0, bench_radius - kOverlap));
        world.start();
        return whole;
    };
    return find_limit(build, {{1, 0, 0}, 2000}, 2 / std::sqrt(3.5 * ratio));
}

// A face-centred cubic block with twelve contacts a grain inside, pressed by its six walls. block_at_rest()
// brings it to rest.
std::unique_ptr<SmallWorld> block(int planes, const PairPlan& pair, double step) {
    auto whole = std::make_unique<SmallWorld>(pair, step);
    SmallWorld& world = *whole;
    const double half_edge = (2 * bench_radius - kOverlap) / std::sqrt(2.0);
    const double middle = 0.5 * (planes - 1), reach = middle * half_edge + bench_radius - 2 * kOverlap;
    for (int x = 0; x < planes; ++x)
        for (int y = 0; y < planes; ++y)
            for (int z = 0; z < planes; ++z)
                if ((x + y + z) % 2 == 0) world.add(half_edge * (Vec3(x, y, z) - Vec3::Constant(middle)));
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            world.add_plane(side * reach * Vec3::Unit(axis), -side * Vec3::Unit(axis));
    return whole;
}

Grains block_at_rest(int planes) {
    const auto world = block(planes, spring(1, 0, 0), 0.1 * unit());
    world->start();
    world->loop->run(0, 10000, world->plan.clock.step, 0.2 / unit());
    for (Motion& motion : world->grains.motion) motion.velocity.setZero();
    return world->grains;
}

Finding bed_limit(bool quick, const PairPlan& pair, double theory) {
    const int planes = quick ? 7 : 11;
    const Grains at_rest = block_at_rest(planes);
    const auto build = [&](double step) {
        auto world = block(planes, pair, step);
        world->grains = at_rest;
        world->start();
        return world;
    };
    Finding finding = find_limit(build, {{1, 1, 1}, 1000}, theory);
    for (CurvePoint& point : finding.curve)
        point.theory = kUnknown;  // no curve, because there are many modes
    return finding;
}

}  // namespace

std::vector<Experiment> step_experiments() {
    const std::string guard = "health check; the plan's step; check warns above the stable limit";
    const std::string step = "step / sqrt(m/K)";
    std::vector<Experiment> all;
    for (const auto& word : integrator_words) all.push_back(pair_limit(word.second));
    all.push_back({"step: pair that unloads (e = 0.5)", step, Failing::loud, guard, unloading_limit});
    all.push_back({"step: tangential spring (K0 = 0.8 K)", step, Failing::loud, guard, sideways_limit});
    all.push_back({"step: chain of 20", step, Failing::loud, guard, chain_limit});
    // Central springs in a face-centred cubic crystal have omega^2 = 8 K / m at most.
    all.push_back({"step: dense bed (smooth)", step, Failing::loud, guard,
                   [](bool quick) { return bed_limit(quick, spring(1, 0, 0), 2 / std::sqrt(8.0)); }});
    // Gerschgorin's bound with spins is 40 K0 / m; it need not be reached.
    all.push_back({"step: dense bed (K0 = 0.8 K)", step, Failing::loud, guard, [](bool quick) {
                       return bed_limit(quick, spring(1, 1e6, 0.8), 2 / std::sqrt(40 * 0.8));
                   }});
    return all;
}

namespace {

// Finds the spectral radius by Gelfand's formula, the limit of |A^n|^(1/n), doubling n again and again.
template <class Matrix>
double spectral_radius(Matrix power) {
    double logarithm = 0, share = 1;  // logarithm of |A^n|, and 1/n
    for (int doubling = 0; doubling < 48; ++doubling) {
        const double size = power.norm();
        logarithm += share * math::log(size);
        power /= size;
        power = (power * power).eval();
        share /= 2;
    }
    return math::exp(logarithm);
}

// The matrix by which one step acts on (x, v), where x'' = -x.
Eigen::Matrix2d kicks_and_drifts(const Scheme& scheme, double h) {
    const auto kick = [h](double share) { return Eigen::Matrix2d{{1, 0}, {-share * h, 1}}; };
    const auto drift = [h](double share) { return Eigen::Matrix2d{{1, share * h}, {0, 1}}; };
    Eigen::Matrix2d step = kick(scheme.opening_kick);
    for (const Stage& stage : scheme.stages) step = kick(stage.kick) * drift(stage.drift) * step;
    return drift(scheme.closing_drift) * step;
}

// The matrix by which one step of Gear's scheme acts on (x, h x', h^2 x''/2, h^3 x'''/6). Pascal's triangle
// predicts, and 1/6, 5/6, 1, 1/3 correct (Allen & Tildesley, Computer Simulation of Liquids, app. E).
Eigen::Matrix4d gear(double h) {
    const Eigen::Matrix4d predicted{{1, 1, 1, 1}, {0, 1, 2, 3}, {0, 0, 1, 3}, {0, 0, 0, 1}};
    const Eigen::Vector4d weights(1.0 / 6, 5.0 / 6, 1, 1.0 / 3);
    const Eigen::RowVector4d error =
        -0.5 * h * h * predicted.row(0) - predicted.row(2);  // h^2/2 (force - x'')
    return predicted + weights * error;
}

}  // namespace

double growth_a_step(Integrator integrator, double step) {
    const Scheme scheme = scheme_of(integrator);
    return scheme.corrects ? spectral_radius(gear(step)) : spectral_radius(kicks_and_drifts(scheme, step));
}

double stability_limit(Integrator integrator) {
    constexpr double round_off = 1e-6, coarse = 0.01;
    const auto stable = [&](double step) { return growth_a_step(integrator, step) <= 1 + round_off; };
    double step = coarse;
    while (stable(step + coarse)) step += coarse;
    return last_that_holds(step, step + coarse, 40, stable);
}

}  // namespace grainreel
