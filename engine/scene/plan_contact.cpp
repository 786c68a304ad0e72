// Stiffness by the three conditions of the bed: impacts, weight, and waves that cross it within a period.
// Symbols: d smaller diameter, m effective mass, eps wanted overlap over d, v* impact speed, h bed height.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/plan_parts.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// Settling is short, and nobody looks: overlaps may be this large there.
constexpr double settling_overlap = 0.05;
// A plastic block on the plate hits it at up to 2.13 a omega for Gamma from 1.2 to 10.
constexpr double plastic_block_speed = 2.2;

double mass_of(const Species& species, double diameter) {
    return species.density * pi / 6 * diameter * diameter * diameter;
}

double reduced_mass(double a, double b) {
    return std::isinf(b) ? a : a * b / (a + b);
}

std::string place_of_pair(const Species& a, const Species* b) {
    return fmt::format("\"{}\" and {}", a.name, b == nullptr ? "the wall" : "\"" + b->name + "\"");
}

// Top speed of a grain over the drive's a omega. A single ball on a plate of random phase gains and loses
// until <v^2> = (1 + e) / (1 - e) (a omega)^2 / 2, and rarely has more than three times that speed. In a bed
// of n layers a blow passes 2n - 1 contacts before it is back at the plate: e becomes e^(2n-1), and for a
// deep bed that is the plastic block. (The two ends are derived, the exponent is an estimate.)
double speed_over_drive(double restitution, double layers) {
    const double whole = std::min(0.98, std::pow(restitution, 2 * layers - 1));
    return std::max(plastic_block_speed, 3 * std::sqrt((1 + whole) / (2 * (1 - whole))));
}

// Times sqrt(m / K): the duration of a free impact.
double contact_time_factor(NormalLaw law, const PairContact& contact) {
    if (law == NormalLaw::walton_braun) return pi / 2 * (1 + contact.restitution);
    if (contact.normal_damping) return pi;
    const double logarithm = std::log(contact.restitution);
    return std::sqrt(pi * pi + logarithm * logarithm);  // pi / sqrt(1 - beta^2)
}

// The weight that rests on one grain, over its diameter: K1 >= load / eps.
double static_load(const BedPlan& bed, double diameter) {
    return 3 * (1 + bed.g_level) * settled_solid_fraction * bed.largest_density * bed.gravity *
           bed.carried_height * diameter;
}

struct Stiffness {
    double value = 0;
    std::string reason;
};

Stiffness choose_stiffness(const Scene& scene, const BedPlan& bed, const PairContact& contact,
                           const Species& a, const Species* b) {
    if (contact.stiffness) return {*contact.stiffness, "the scene"};
    Stiffness chosen;
    const auto demand = [&](double value, const char* reason) {
        if (value > chosen.value) chosen = {value, reason};
    };
    const double eps = scene.run.overlap;
    const double time_factor = contact_time_factor(scene.contact.normal, contact);
    for (const Touching& t : extremes(a, b)) {
        demand(t.effective_mass * std::pow(bed.impact_speed / (eps * t.diameter), 2), "impact");
        demand(static_load(bed, t.diameter) / eps, "static load");
        if (bed.gravity > 0)  // t_c <= 0.1 d / (f h)
            demand(
                t.effective_mass * std::pow(time_factor * bed.frequency * bed.height / (0.1 * t.diameter), 2),
                "wave");
    }
    if (chosen.value > 0) return chosen;
    throw UserError(
        fmt::format("{}: 'stiffness' is missing between {}, and with neither drive nor gravity nothing says "
                    "how large it must be; write for example stiffness = \"2e4 N/m\"",
                    scene.where("contact"), place_of_pair(a, b)));
}

// Damping and restitution of the spring-dashpot, each from the other: beta = -ln e / sqrt(pi^2 + ln^2 e), the
// law being free to pull at the end of contact; damping = 2 beta omega0 at the mean effective mass.
void plan_damping(const Scene& scene, PairPlan& pair, const PairContact& contact, const Species& a,
                  const Species* b) {
    const double natural = std::sqrt(pair.loading_stiffness / mean_effective_mass(a, b));
    if (!contact.normal_damping) {
        const double logarithm = std::log(contact.restitution);
        pair.normal_damping = -2 * natural * logarithm / std::sqrt(pi * pi + logarithm * logarithm);
    } else {
        pair.normal_damping = *contact.normal_damping;
        double critical = std::numeric_limits<double>::infinity();
        for (const Touching& t : extremes(a, b))
            critical = std::min(critical, 2 * std::sqrt(pair.loading_stiffness / t.effective_mass));
        if (pair.normal_damping >= critical)
            throw UserError(fmt::format(
                "{}: 'normal_damping' of {:.6g} 1/s between {} is not below the critical {:.6g} "
                "1/s, so that nothing rebounds; reduce it or raise the stiffness",
                scene.where("contact.normal_damping"), pair.normal_damping, place_of_pair(a, b), critical));
        const double beta = pair.normal_damping / (2 * natural);
        pair.restitution = std::exp(-pi * beta / std::sqrt(1 - beta * beta));
    }
    if (scene.contact.tangential == TangentialLaw::linear_spring)
        pair.tangential_damping = contact.tangential_damping.value_or(pair.normal_damping / 2);
}

// e(v) = sqrt(w0 / (w0 + S v)), w0 = sqrt(K1 / m) (Walton & Braun 1986): S from one point of it, at the mean
// effective mass; then e as it is at v* of the heaviest pair, for step and contact time.
void plan_hardening(const BedPlan& bed, PairPlan& pair, const PairContact& contact, const Species& a,
                    const Species* b) {
    const double natural = std::sqrt(pair.loading_stiffness / mean_effective_mass(a, b));
    const double e = contact.restitution;
    pair.hardening = natural * (1 / (e * e) - 1) / *contact.restitution_speed;
    double slowest = natural;
    for (const Touching& t : extremes(a, b))
        slowest = std::min(slowest, std::sqrt(pair.loading_stiffness / t.effective_mass));
    pair.restitution = std::sqrt(slowest / (slowest + pair.hardening * bed.impact_speed));
}

}  // namespace

std::vector<Touching> extremes(const Species& a, const Species* b) {
    std::vector<Touching> all;
    for (const double first : {a.diameter.smallest, a.diameter.mean, a.diameter.largest}) {
        const double mass = mass_of(a, first);
        if (b == nullptr) {
            all.push_back({first, first / 2, mass});
            continue;
        }
        for (const double second : {b->diameter.smallest, b->diameter.mean, b->diameter.largest})
            all.push_back(
                {std::min(first, second), (first + second) / 2, reduced_mass(mass, mass_of(*b, second))});
    }
    return all;
}

double mean_effective_mass(const Species& a, const Species* b) {
    const double mass = mass_of(a, a.diameter.mean);
    return b == nullptr ? mass : reduced_mass(mass, mass_of(*b, b->diameter.mean));
}

BedPlan plan_bed(const Scene& scene) {
    BedPlan bed;
    const Drive& drive = scene.drive;
    bed.gravity = scene.gravity.norm();
    if (drive.present) bed.frequency = drive.frequency;
    if (drive.present && bed.gravity > 0) bed.g_level = drive.g_level(bed.gravity);
    bed.height = fill_height(scene, settled_solid_fraction);
    bed.carried_height = std::min(bed.height, 2 * bed_width(scene));
    double diameters = 0;
    for (const Species& s : scene.species) {
        bed.largest_density = std::max(bed.largest_density, s.density);
        bed.largest_mass = std::max(bed.largest_mass, mass_of(s, s.diameter.largest));
        diameters += static_cast<double>(s.count) * s.diameter.mean;
    }
    bed.layers = std::max(1.0, bed.height * static_cast<double>(scene.grains()) / diameters);

    double restitution = 0;
    for (const PairContact& pair : scene.contact.grain) restitution = std::max(restitution, pair.restitution);
    if (drive.present) bed.impact_speed = speed_over_drive(restitution, bed.layers) * drive.speed();
    const double fall = std::sqrt(2 * bed.gravity * (scene.container.height - bed.height));
    if (scene.start.method == Start::Method::layers) {
        bed.drop_speed = fall;
        bed.impact_speed = std::max(bed.impact_speed, fall * scene.run.overlap / settling_overlap);
    } else if (!drive.present) {
        bed.impact_speed = fall;  // all that one can know of a bed that starts from a file
    }
    return bed;
}

PairPlan plan_pair(const Scene& scene, const BedPlan& bed, const PairContact& contact, const Species& a,
                   const Species* b) {
    PairPlan pair;
    const Stiffness stiffness = choose_stiffness(scene, bed, contact, a, b);
    const bool rubs = scene.contact.tangential != TangentialLaw::none && contact.friction > 0;
    pair.loading_stiffness = stiffness.value;
    pair.stiffness_reason = stiffness.reason;
    pair.restitution = contact.restitution;
    pair.friction = rubs ? contact.friction : 0;
    if (scene.contact.tangential != TangentialLaw::none)
        pair.tangential_stiffness = contact.tangential_ratio * stiffness.value;
    pair.gamma = scene.contact.tangential == TangentialLaw::incremental_slip ? contact.gamma : 0;
    const std::vector<Touching> touching = extremes(a, b);
    pair.effective_mass = touching.front().effective_mass;  // of the smallest of each
    pair.allowed_overlap = scene.run.overlap * touching.front().diameter;
    const double natural = std::sqrt(pair.loading_stiffness / pair.effective_mass);
    if (scene.contact.normal == NormalLaw::walton_braun) {
        if (contact.restitution_speed) plan_hardening(bed, pair, contact, a, b);
        pair.unloading_stiffness = pair.loading_stiffness / (pair.restitution * pair.restitution);
        pair.contact_time = pi / 2 * (1 + pair.restitution) / natural;
    } else {
        pair.unloading_stiffness = pair.loading_stiffness;
        plan_damping(scene, pair, contact, a, b);
        const double beta = pair.normal_damping / (2 * natural);
        pair.contact_time = pi / (natural * std::sqrt(1 - beta * beta));
    }
    return pair;
}

double expected_overlap(const Scene& scene, const BedPlan& bed, const PairPlan& pair, const Species& a,
                        const Species* b) {
    double largest = 0;
    for (const Touching& t : extremes(a, b)) {
        const double load = std::max(t.effective_mass, bed.largest_mass / 3);
        const double impact = bed.impact_speed * std::sqrt(load / pair.loading_stiffness) / t.diameter;
        const double weight = static_load(bed, t.diameter) / pair.loading_stiffness;
        largest = std::max({largest, impact, scene.drive.present || bed.gravity > 0 ? weight : 0.0});
    }
    return largest;
}

}  // namespace grainreel
