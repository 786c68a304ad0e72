#include "engine/lab/chart/accuracy/promised_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/lab/chart/bench.hpp"

namespace grainreel {
namespace {

struct Impactors {
    Bench::Sphere first, second;
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
    // Where nothing says how fast impacts are: so fast that the overlap is the allowed one.
    two.speed = plan.impact_speed > 0
                    ? plan.impact_speed
                    : pair.allowed_overlap * std::sqrt(pair.loading_stiffness / two.effective_mass);
    return two;
}

double rebound(const Plan& plan, const PairPlan& pair, const Impactors& two, double phase) {
    Bench bench(pair, plan.clock.step, plan.integrator);
    const double gap = phase * two.speed * plan.clock.step;
    const Vec3 towards(0, 0, two.speed);
    bench.around.skin = 0.2 * two.first.radius;
    bench.add(Vec3::Zero(), towards, two.first);
    if (two.wall) {
        bench.add_plane(Vec3(0, 0, two.first.radius + gap), Vec3(0, 0, -1));
    } else {
        bench.around.skin = 0.2 * std::min(two.first.radius, two.second.radius);
        bench.add(Vec3(0, 0, two.first.radius + two.second.radius + gap), Vec3::Zero(), two.second);
    }
    bench.start();
    const auto contact = static_cast<std::int64_t>(std::ceil(pair.contact_time / plan.clock.step));
    double closing = two.speed;
    // Most contacts end within twice their time; an overdamped one creeps out.
    for (int times = 0; times < 40; ++times) {
        bench.run(contact + 2);
        const double before = closing;
        closing = bench.velocity(0).z() - (two.wall ? 0 : bench.velocity(1).z());
        if (times > 0 && closing < 0 && closing == before) break;  // parted
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
    constexpr double kFewest = 2, kMost = 1000;  // steps: trying longer contacts takes minutes
    const double steps = pair.contact_time / plan.clock.step;
    if (!(steps >= kFewest && steps <= kMost)) return std::numeric_limits<double>::quiet_NaN();
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
    error *= 1.01;  // the worst onset lies between those that were tried: 0.6 % more was seen
    const double digit = std::pow(10, std::floor(std::log10(error)) - 1);
    return fmt::format("{:.2g}", digit * std::ceil(error / digit * (1 - 1e-9)));
}

}  // namespace grainreel
