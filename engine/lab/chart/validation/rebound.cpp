#include "engine/lab/chart/validation/rebound.hpp"

#include <cmath>

#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/validation/kharaz.hpp"
#include "engine/plan/damping.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

using kharaz::radius, kharaz::density, kharaz::speed;
constexpr double depth = 0.001 * radius;  // m, at normal incidence
constexpr int steps_per_contact = 200;

PairPlan pair_of(const ImpactLaw& law, double effective_mass, double effective_radius) {
    const double e = law.restitution;
    PairPlan pair;
    pair.model = {law.normal, law.tangential, false, law.precision};
    pair.restitution = e;
    pair.friction = law.friction;
    pair.loading_stiffness = effective_mass * std::pow(speed / depth, 2);
    pair.unloading_stiffness = pair.loading_stiffness / (e * e);
    pair.tangential_ratio = law.stiffness_ratio;
    pair.tangential_stiffness = law.stiffness_ratio * pair.loading_stiffness;
    pair.gamma = 1.0 / 3;
    if (law.normal == NormalForce::hertz) {  // depth = (5 m v^2 / 4k)^(2/5), k = 4/3 E* sqrt R
        const double k = 1.25 * effective_mass * speed * speed / std::pow(depth, 2.5);
        pair.modulus = 0.75 * k / std::sqrt(effective_radius);
        pair.hertz_damping = hertz_damping(e, false);
    }
    return pair;
}

double contact_time(const ImpactLaw& law) {
    return law.normal == NormalForce::hertz ? 2.943 * depth / speed
                                            : pi / 2 * (1 + law.restitution) * depth / speed;
}

}  // namespace

Rebound rebound(const ImpactLaw& law, double degrees, Target target) {
    const double mass = density * sphere_volume(radius), share = target == Target::plane ? 1 : 0.5;
    const double length = contact_time(law) / steps_per_contact;
    const double angle = degrees * pi / 180, along = speed * std::sin(angle), down = speed * std::cos(angle);
    Bench bench(pair_of(law, share * mass, share * radius), length);
    const Vec3 approach(along, 0, -down);
    const double gap = 0.4 * down * length;
    if (target == Target::plane) {
        bench.add_plane(Vec3(0, 0, 0), Vec3(0, 0, 1));
        bench.add(Vec3(0, 0, radius + gap), approach, {radius, density});
    } else {
        bench.add(Vec3(0, 0, radius + gap / 2), approach / 2, {radius, density});
        bench.add(Vec3(0, 0, -radius - gap / 2), -approach / 2, {radius, density});
    }
    bench.start();
    bench.run(3 * steps_per_contact);
    Rebound after{0, 0, 0};
    for (std::size_t i = 0; i < bench.grains.size(); ++i) {
        const Vec3& v = bench.grains.motion[i].velocity;
        const double side = bench.grains.id[i] == 0 ? 1 : -1;
        after.normal += side * v.z() / speed;
        after.tangential += side * v.x() / speed;
        after.spin += radius * bench.grains.motion[i].spin.y() / speed;
    }
    return after;
}

double ratio_that_turns(double restitution, double beta0) {
    const double turn = pi - std::acos(beta0);
    return std::pow(turn / (pi / 2 * (1 + restitution)), 2) / 3.5;
}

}  // namespace grainreel
