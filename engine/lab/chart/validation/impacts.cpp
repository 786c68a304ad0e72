// Compares oblique impacts with the measurements of Kharaz et al. (2001) and Foerster et al. (1994).
#include "engine/lab/chart/validation/impacts.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/lab/chart/validation/validation.hpp"
#include "engine/plan/damping.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

struct NamedLaw {
    std::string name;
    ImpactLaw law;
};

// Laws for alumina on glass. The ratio of tangential to normal stiffness is 4 G*/E* (Mindlin) with E = 380
// and 70 GPa, nu = 0.23 and 0.25 (Chung & Ooi 2011).
std::vector<NamedLaw> alumina_laws() {
    const double ratio = 0.86, e = kharaz::restitution, mu = kharaz::friction;
    return {{"incremental slip", {NormalForce::walton_braun, TangentialLaw::incremental_slip, e, mu, ratio}},
            {"Hertz-Mindlin", {NormalForce::hertz, TangentialLaw::mindlin, e, mu, ratio}}};
}

enum class Quantity { tangential_restitution, spin, rebound };

double measured(const Rebound& after, double degrees, Quantity quantity) {
    switch (quantity) {
        case Quantity::tangential_restitution:
            return after.tangential / math::sin(degrees * pi / 180);
        case Quantity::spin:
            return after.spin * kharaz::speed / kharaz::radius;
        case Quantity::rebound:
            break;
    }
    return math::atan2(after.tangential, after.normal) * 180 / pi;
}

struct Compared {
    std::string name;
    Quantity quantity;
    const std::vector<kharaz::Point>& published;
};
std::vector<Compared> compared() {
    return {{"tangential restitution", Quantity::tangential_restitution, kharaz::tangential_restitution},
            {"spin rad/s", Quantity::spin, kharaz::spin},
            {"rebound deg", Quantity::rebound, kharaz::rebound}};
}

// Writes our results at many angles, and at the published ones.
void alumina(const ChartRequest& request) {
    std::string lines = "law,degrees,tangential_restitution,spin_rad_s,rebound_deg\n";
    std::string points = "quantity,degrees,published,incremental_slip,difference,hertz_mindlin,difference\n";
    for (const NamedLaw& named : alumina_laws()) {
        for (int degrees = 1; degrees < 90; degrees += request.quick ? 4 : 1) {
            const Rebound after = rebound(named.law, degrees, Target::plane);
            lines += fmt::format("{},{}", named.name, degrees);
            for (const Compared& c : compared())
                lines += fmt::format(",{:.5g}", measured(after, degrees, c.quantity));
            lines += "\n";
        }
    }
    for (const Compared& c : compared()) {
        for (const kharaz::Point& p : c.published) {
            points += fmt::format("{},{},{}", c.name, p.degrees, p.value);
            for (const NamedLaw& named : alumina_laws()) {
                const Rebound after = rebound(named.law, p.degrees, Target::plane);
                const double is = measured(after, p.degrees, c.quantity);
                points += fmt::format(",{:.4g},{:+.2g}", is, is - p.value);
            }
            points += "\n";
        }
    }
    replace_file(request.folder / "alumina.csv", lines);
    replace_file(request.folder / "alumina_points.csv", points);
}

struct Material {
    std::string name;
    double e, mu, beta0;
};

// Rows for impacts of two equal spheres. Slips are divided by the normal speed before the impact. The
// published value is no measured point: it is the slip that Foerster's model gives with their e, mu and
// beta0. The model has one line for contacts that slide and one for contacts that stick, and the larger value
// counts.
std::string binary_rows(const Material& m, const NamedLaw& named, double step) {
    std::string rows;
    const double sliding = 3.5 * (1 + m.e) * m.mu;
    for (double share = step; share < 3.05; share += step) {
        const double before = share * sliding, angle = math::atan(before);
        const Rebound after = rebound(named.law, angle * 180 / pi, Target::equal_sphere);
        const double is = (after.tangential - after.spin) / math::cos(angle);
        const double published = std::max(before - sliding, -m.beta0 * before);
        rows += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:+.4f}\n", m.name, named.name, before, is, published,
                            is - published);
    }
    return rows;
}

void binary(const ChartRequest& request) {
    std::string table = "material,law,slip_before,slip_after,published,difference\n";
    for (const Material& m : {Material{"glass", 0.97, 0.092, 0.44}, Material{"acetate", 0.87, 0.25, 0.43}}) {
        const double ratio = ratio_that_turns(m.e, m.beta0);
        for (const NamedLaw& named :
             {NamedLaw{"incremental slip",
                       {NormalForce::walton_braun, TangentialLaw::incremental_slip, m.e, m.mu, ratio}},
              NamedLaw{"linear spring",
                       {NormalForce::walton_braun, TangentialLaw::linear_spring, m.e, m.mu, ratio}}})
            table += binary_rows(m, named, request.quick ? 0.5 : 0.1);
    }
    replace_file(request.folder / "binary.csv", table);
}

bool run_impacts(const ChartRequest& request, ChartWork& work) {
    if (!work.next("oblique impacts of alumina on glass")) return false;
    alumina(request);
    if (!work.next("binary impacts of glass and acetate")) return false;
    binary(request);
    return true;
}

}  // namespace

const ValidationPart impact_part = {[](bool) { return std::size_t{2}; }, run_impacts};

namespace {

using std::numbers::pi;

using kharaz::radius, kharaz::density, kharaz::speed;
constexpr double kDepth = 0.001 * radius;  // m, largest overlap at normal incidence
constexpr int steps_per_contact = 200;

PairPlan pair_of(const ImpactLaw& law, double effective_mass, double effective_radius) {
    const double e = law.restitution;
    PairPlan pair;
    pair.model = {law.normal, law.tangential, false, law.precision};
    pair.restitution = e;
    pair.friction = law.friction;
    pair.loading_stiffness = effective_mass * math::square(speed / kDepth);
    pair.unloading_stiffness = pair.loading_stiffness / (e * e);
    pair.tangential_ratio = law.stiffness_ratio;
    pair.tangential_stiffness = law.stiffness_ratio * pair.loading_stiffness;
    pair.gamma = 1.0 / 3;
    if (law.normal == NormalForce::hertz) {  // depth = (5 m v^2 / 4k)^(2/5), k = 4/3 E* sqrt R
        const double k = 1.25 * effective_mass * speed * speed / math::pow(kDepth, 2.5);
        pair.modulus = 0.75 * k / std::sqrt(effective_radius);
        pair.hertz_damping = hertz_damping(e, false);
    }
    return pair;
}

double contact_time(const ImpactLaw& law) {
    return law.normal == NormalForce::hertz ? 2.943 * kDepth / speed
                                            : pi / 2 * (1 + law.restitution) * kDepth / speed;
}

}  // namespace

Rebound rebound(const ImpactLaw& law, double degrees, Target target) {
    const double mass = density * sphere_volume(radius), share = target == Target::plane ? 1 : 0.5;
    const double length = contact_time(law) / steps_per_contact;
    const double angle = degrees * pi / 180, along = speed * math::sin(angle),
                 down = speed * math::cos(angle);
    SmallWorld world(pair_of(law, share * mass, share * radius), length);
    const Vec3 approach(along, 0, -down);
    const double gap = 0.4 * down * length;
    if (target == Target::plane) {
        world.add_plane(Vec3(0, 0, 0), Vec3(0, 0, 1));
        world.add(Vec3(0, 0, radius + gap), approach, {radius, density});
    } else {
        world.add(Vec3(0, 0, radius + gap / 2), approach / 2, {radius, density});
        world.add(Vec3(0, 0, -radius - gap / 2), -approach / 2, {radius, density});
    }
    world.start();
    world.run(3 * steps_per_contact);
    Rebound after{0, 0, 0};
    for (std::size_t i = 0; i < world.grains.size(); ++i) {
        const Vec3& v = world.grains.motion[i].velocity;
        const double side = world.grains.id[i] == 0 ? 1 : -1;
        after.normal += side * v.z() / speed;
        after.tangential += side * v.x() / speed;
        after.spin += radius * world.grains.motion[i].spin.y() / speed;
    }
    return after;
}

double ratio_that_turns(double restitution, double beta0) {
    const double turn = pi - math::acos(beta0);
    return math::square(turn / (pi / 2 * (1 + restitution))) / 3.5;
}

}  // namespace grainreel
