#include "engine/lab/chart/accuracy/single_contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/plan/damping.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

constexpr double kRadius = bench_radius, kStiffness = bench_stiffness;
constexpr double kSpeed = 0.3;  // m/s, of impacts
constexpr double kFriction = 0.3;

double mass() {
    return bench_mass();
}

// The plan of contacts by this method. `effective_mass` (kg) is that of the contact whose restitution is to
// be right.
PairPlan pair_of(const Method& method, double restitution, double effective_mass) {
    PairPlan pair;
    pair.model = {method.normal, method.tangential, false, method.precision};
    pair.restitution = restitution;
    pair.loading_stiffness = kStiffness;
    pair.unloading_stiffness = kStiffness / (restitution * restitution);
    pair.tangential_ratio = method.normal == NormalForce::hertz ? 2 * 0.7 / 1.7 : 0.8;
    pair.tangential_stiffness = pair.tangential_ratio * kStiffness;
    pair.gamma = 1.0 / 3;
    pair.friction = method.tangential == TangentialLaw::none ? 0 : kFriction;
    const double natural = std::sqrt(kStiffness / effective_mass);
    if (method.normal == NormalForce::spring_dashpot)
        pair.normal_damping = 2 * natural * linear_damping(restitution, false);
    pair.tangential_damping = pair.normal_damping / 2;
    pair.modulus = 2e8;
    if (method.normal == NormalForce::hertz) pair.hertz_damping = hertz_damping(restitution, false);
    return pair;
}

// Duration (s) of a free impact.
double contact_time(const Method& method, double restitution, double effective_mass,
                    double effective_radius) {
    const double natural = std::sqrt(kStiffness / effective_mass);
    if (method.normal == NormalForce::spring_dashpot) {
        const double beta = linear_damping(restitution, true);
        return pi / (natural * std::sqrt(1 - beta * beta));
    }
    if (method.normal == NormalForce::hertz) {
        const double k = 4.0 / 3 * 2e8 * std::sqrt(effective_radius);
        return hertz_contact_time(effective_mass, k, kSpeed);
    }
    return pi / 2 * (1 + restitution) / natural;
}

}  // namespace

int Method::forces_a_step() const {
    return static_cast<int>(scheme_of(integrator).stages.size());
}

NormalErrors normal_errors(const Method& method, double restitution, double steps, int phases) {
    Method smooth = method;
    smooth.tangential = TangentialLaw::none;
    const double effective = mass() / 2;
    const double time = contact_time(smooth, restitution, effective, kRadius / 2), length = time / steps;
    NormalErrors errors;
    for (int phase = 0; phase < phases; ++phase) {
        SmallWorld world(pair_of(smooth, restitution, effective), length, smooth.integrator);
        const double apart = kRadius + 0.5 * (phase + 0.5) / phases * kSpeed * length;
        world.add(Vec3(-apart, 0, 0), Vec3(kSpeed / 2, 0, 0));
        world.add(Vec3(apart, 0, 0), Vec3(-kSpeed / 2, 0, 0));
        world.start();
        double pushed = 0;
        const std::int64_t most = static_cast<std::int64_t>(std::ceil(3 * steps)) + 5;
        for (std::int64_t n = 0; n < most; ++n) {
            world.run(1);
            pushed += world.grains.load[0].force.squaredNorm() > 0;
        }
        const double e = (world.grains.motion[1].velocity - world.grains.motion[0].velocity).x() / kSpeed;
        // The loop sorts grains by place. On a line, [1] is therefore the one ahead.
        errors.restitution = std::max(errors.restitution, std::abs(std::abs(e) - restitution));
        errors.contact_time = std::max(errors.contact_time, std::abs(pushed / steps - 1));
    }
    return errors;
}

namespace {

struct ObliqueRebound {
    double velocity, spin;  // divided by the speed before the impact
};

ObliqueRebound oblique(const Method& method, double restitution, double steps, double angle) {
    const double time = contact_time(method, restitution, mass(), kRadius), length = time / steps;
    SmallWorld world(pair_of(method, restitution, mass()), length, method.integrator);
    world.add_floor();
    const double down = kSpeed * math::cos(angle);
    world.add(Vec3(0, 0, kRadius + 0.5 * down * length), Vec3(kSpeed * math::sin(angle), 0, -down));
    world.start();
    // A grazing impact of a Hertz contact lasts longer: the time grows with speed^(-1/5).
    world.run(static_cast<std::int64_t>(std::ceil(4 * steps)) + 5);
    return {world.grains.motion[0].velocity.x() / kSpeed, kRadius * world.grains.motion[0].spin.y() / kSpeed};
}

}  // namespace

ObliqueErrors oblique_errors(const Method& method, double restitution, double steps) {
    Method reference = method;
    reference.integrator = Integrator::velocity_verlet;
    if (reference.normal == NormalForce::walton_braun_corrected) reference.normal = NormalForce::walton_braun;
    // The corrected law is of second order, which makes it the better reference.
    if (reference.normal == NormalForce::walton_braun) reference.normal = NormalForce::walton_braun_corrected;
    ObliqueErrors errors;
    for (int degrees = 0; degrees <= 85; degrees += 5) {
        const double angle = degrees * pi / 180;
        const ObliqueRebound is = oblique(method, restitution, steps, angle);
        const ObliqueRebound should = oblique(reference, restitution, 4000, angle);
        errors.velocity = std::max(errors.velocity, std::abs(is.velocity - should.velocity));
        errors.spin = std::max(errors.spin, std::abs(is.spin - should.spin));
    }
    return errors;
}

namespace {

// Tangential velocity divided by that of the initial push, at 24 times evenly spread over three contact
// times.
std::vector<double> shear(const Method& method, std::int64_t steps_between, double contact) {
    const double length = contact / (8 * static_cast<double>(steps_between));
    SmallWorld world(pair_of(method, 1, mass()), length, method.integrator);
    world.add_floor();
    const double push = 0.02, gravity = 4 * push * std::sqrt(kStiffness / mass());
    world.around.gravity = {0, 0, -gravity};
    world.add(Vec3(0, 0, kRadius - mass() * gravity / kStiffness), Vec3(push / 2, 0, -push));
    world.start();
    std::vector<double> velocities;
    for (int k = 0; k < 24; ++k) {
        world.run(steps_between);
        velocities.push_back(world.grains.motion[0].velocity.x() / push);
    }
    return velocities;
}

}  // namespace

double shear_error(const Method& method, double steps) {
    const double contact = contact_time(method, 1, mass(), kRadius);
    const auto is = shear(method, static_cast<std::int64_t>(steps / 8), contact);
    const auto should = shear(method, 2500, contact);
    double largest = 0;
    for (std::size_t k = 0; k < is.size(); ++k) largest = std::max(largest, std::abs(is[k] - should[k]));
    return largest;
}

namespace {

double drift_from(double height, double gravity, const Method& method, double length, std::int64_t steps) {
    SmallWorld world(pair_of(method, 1, mass()), length, method.integrator);
    world.add_floor();
    world.around.gravity = {0, 0, -gravity};
    world.add(Vec3(0, 0, kRadius + height), Vec3(0, 0, 0));
    world.start();
    world.run(steps);
    const double end = kinetic_energy(world.grains).translation +
                       mass() * gravity * (world.grains.place[0].position.z() - kRadius) +
                       summarise_contacts(*world.loop, world.step).stored;
    return std::abs(end / (mass() * gravity * height) - 1);
}

}  // namespace

double bounce_drift(const Method& method, double steps, int bounces) {
    constexpr int heights = 8;
    Method smooth = method;
    smooth.tangential = TangentialLaw::none;
    const double touch = contact_time(smooth, 1, mass(), kRadius);
    const double gravity = 2 * kSpeed / (20 * touch), height = 0.5 * kSpeed * kSpeed / gravity;
    double largest = 0;
    for (int k = 0; k < heights; ++k) {
        const double share = 0.9 + 0.2 * (k + 0.5) / heights;
        largest = std::max(largest, drift_from(share * height, gravity, smooth, touch / steps,
                                               static_cast<std::int64_t>(bounces * 21 * steps)));
    }
    return largest;
}

double cost_of_a_contact(const Method& method) {
    constexpr int side = 20, steps = 60;
    SmallWorld world(pair_of(method, 0.9, mass() / 2), 1e-9, method.integrator);
    const double apart = 2 * kRadius * (1 - 1e-4);
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) world.add(apart * Vec3(x, y, z), 0.01 * Vec3(y % 2, z % 2, x % 2));
    world.start();
    const double contacts = 3.0 * side * side * (side - 1) * steps * method.forces_a_step();
    double best = 1e9;
    for (int attempt = 0; attempt < 5; ++attempt) {
        const auto begin = std::chrono::steady_clock::now();
        world.run(steps);
        const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
        best = std::min(best, taken.count() / contacts);
    }
    return best;
}

namespace {

struct Impactors {
    SmallWorld::Sphere first, second;
    bool wall = false;
    double effective_mass = 0;  // kg
    double speed = 0;           // m/s
};

Impactors impactors_of(const Plan& plan, const PairPlan& pair, const Species& a, const Species* b) {
    Impactors two;
    two.first = {a.diameter.smallest / 2, a.density, 0};
    two.wall = b == nullptr;
    if (b != nullptr) two.second = {b->diameter.smallest / 2, b->density, 0};
    const double mass = sphere_mass_of(two.first.radius, two.first.density);
    const double other = sphere_mass_of(two.second.radius, two.second.density);
    two.effective_mass = two.wall ? mass : mass * other / (mass + other);
    // If the plan has no speed of impacts, this is the speed that makes the allowed overlap.
    two.speed = plan.impact_speed > 0
                    ? plan.impact_speed
                    : pair.allowed_overlap * std::sqrt(pair.loading_stiffness / two.effective_mass);
    return two;
}

double rebound(const Plan& plan, const PairPlan& pair, const Impactors& two, double phase) {
    SmallWorld world(pair, plan.clock.step, plan.integrator);
    const double gap = phase * two.speed * plan.clock.step;
    const Vec3 towards(0, 0, two.speed);
    world.around.skin = 0.2 * two.first.radius;
    world.add(Vec3::Zero(), towards, two.first);
    if (two.wall) {
        world.add_plane(Vec3(0, 0, two.first.radius + gap), Vec3(0, 0, -1));
    } else {
        world.around.skin = 0.2 * std::min(two.first.radius, two.second.radius);
        world.add(Vec3(0, 0, two.first.radius + two.second.radius + gap), Vec3::Zero(), two.second);
    }
    world.start();
    const auto contact = static_cast<std::int64_t>(std::ceil(pair.contact_time / plan.clock.step));
    double closing = two.speed;
    // Most contacts end within twice their time; an overdamped one ends slowly.
    for (int times = 0; times < 40; ++times) {
        world.run(contact + 2);
        const double before = closing;
        closing = world.velocity(0).z() - (two.wall ? 0 : world.velocity(1).z());
        if (times > 0 && closing < 0 && closing == before) break;  // the two have parted
    }
    return -closing / two.speed;
}

}  // namespace

std::vector<double> promised_onsets() {
    constexpr int evenly = 60;
    std::vector<double> phases = {1e-3, 1 - 1e-3};
    for (int k = 0; k < evenly; ++k) phases.push_back((k + 0.5) / evenly);
    return phases;
}

double promised_restitution_error(const Plan& plan, const PairPlan& pair, const Species& a,
                                  const Species* b) {
    constexpr double kFewest = 2, kMost = 1000;  // steps; trying longer contacts takes minutes
    const double steps = pair.contact_time / plan.clock.step;
    if (!(steps >= kFewest && steps <= kMost)) return kUnknown;
    PairPlan smooth = pair;
    smooth.model.tangential = TangentialLaw::none;
    smooth.model.rolls = false;
    const Impactors two = impactors_of(plan, smooth, a, b);
    const double exact = smooth.restitution_of(two.effective_mass, two.speed);
    double worst = 0;
    for (const double phase : promised_onsets())
        worst = std::max(worst, std::abs(rebound(plan, smooth, two, phase) - exact));
    return worst;
}

std::string promised_error_text(double error) {
    if (std::isnan(error)) return "-";
    if (error < 1e-12) return "0";
    error *= 1.01;  // the worst phase lies between those that were tried: 0.6 % more was seen
    const double digit = math::pow(10, std::floor(math::log10(error)) - 1);
    return fmt::format("{:.2g}", digit * std::ceil(error / digit * (1 - 1e-9)));
}

}  // namespace grainreel
