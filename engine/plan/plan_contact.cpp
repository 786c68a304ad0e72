// Stiffness by the three conditions of the bed: impacts, weight, and waves that cross it within a period.
// Symbols: d smaller diameter, m effective mass, eps wanted overlap divided by d, v* impact speed, h bed
// height.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/plan/damping.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

std::string place_of_pair(const Species& a, const Species* b) {
    return fmt::format("\"{}\" and {}", a.name, b == nullptr ? "the wall" : "\"" + b->name + "\"");
}

// This factor times sqrt(m / K) is the duration of a free impact with a linear spring.
double contact_time_factor(const PairContact& contact) {
    if (contact.normal == NormalLaw::walton_braun) return pi / 2 * (1 + contact.restitution);
    if (contact.normal_damping) return pi;
    const double logarithm = math::log(contact.restitution);
    return std::sqrt(pi * pi + logarithm * logarithm);  // pi / sqrt(1 - beta^2)
}

// The weight that rests on one grain, divided by its diameter (N/m). The static condition is K1 >= load /
// eps.
double static_load(const BedPlan& bed, double diameter) {
    return 3 * (1 + bed.g_level) * settled_solid_fraction * bed.largest_density * bed.gravity *
           bed.carried_height * diameter;
}

struct Stiffness {
    double value = 0;
    std::string reason;
};

// The largest of several demanded stiffnesses, with its reason.
class Demands {
  public:
    void add(double value, const char* reason) {
        if (value > chosen_.value) chosen_ = {value, reason};
    }
    const Stiffness& chosen() const { return chosen_; }

  private:
    Stiffness chosen_;
};

void demand_stiffness(const Scene& scene, const BedPlan& bed, const PairContact& contact, const PairSizes& t,
                      Demands& demands) {
    const double eps = scene.run.overlap;
    demands.add(t.effective_mass * math::square(bed.impact_speed / (eps * t.diameter)), "impact");
    demands.add(static_load(bed, t.diameter) / eps, "static load");
    if (bed.gravity == 0) return;  // the condition of waves is t_c <= 0.1 d / (f h)
    const double share = contact_time_factor(contact) * bed.frequency * bed.height / (0.1 * t.diameter);
    demands.add(t.effective_mass * share * share, "wave");
}

// Makes the same demands of Hertz' effective modulus E*.
void demand_modulus(const Scene& scene, const BedPlan& bed, const PairSizes& t, Demands& demands) {
    const double allowed = scene.run.overlap * t.diameter, m = t.effective_mass, v = bed.impact_speed;
    const double to_modulus = 0.75 / std::sqrt(t.effective_radius);  // turns k into E*
    demands.add(to_modulus * 1.25 * m * v * v / math::pow(allowed, 2.5), "impact");
    demands.add(to_modulus * static_load(bed, t.diameter) * t.diameter / math::pow(allowed, 1.5),
                "static load");
    if (bed.gravity == 0 || v == 0) return;
    const double longest = 0.1 * t.diameter / (bed.frequency * bed.height);
    demands.add(to_modulus * m * math::pow(hertz_contact_time(1, 1, v) / longest, 2.5), "wave");
}

Stiffness choose_stiffness(const Scene& scene, const BedPlan& bed, const PairContact& contact,
                           const Species& a, const Species* b) {
    if (contact.stiffness) return {*contact.stiffness, "the scene"};
    const bool hertz = contact.normal == NormalLaw::hertz;
    Demands demands;
    for (const PairSizes& t : extremes(a, b))
        hertz ? demand_modulus(scene, bed, t, demands) : demand_stiffness(scene, bed, contact, t, demands);
    if (demands.chosen().value > 0) return demands.chosen();
    throw UserError(
        "{}: '{}' is missing between {}, and with neither drive nor gravity nothing says "
        "how large it must be; write for example {}",
        scene.where("contact"), hertz ? "modulus" : "stiffness", place_of_pair(a, b),
        hertz ? "modulus = \"1 GPa\"" : "stiffness = \"2e4 N/m\"");
}

// Finds the damping of the spring-dashpot from the restitution, or the restitution from the damping;
// damping = 2 beta omega0. A wanted restitution holds for grains of every size. With a given damping each
// size has its own restitution, and the plan takes that of the mean effective mass.
void plan_damping(const Scene& scene, PairPlan& pair, const PairContact& contact, const Species& a,
                  const Species* b) {
    const double natural = std::sqrt(pair.loading_stiffness / mean_effective_mass(a, b));
    const bool one_size =
        a.diameter.smallest == a.diameter.largest && (!b || b->diameter.smallest == b->diameter.largest);
    if (!contact.normal_damping) {
        const double beta = linear_damping(contact.restitution, contact.attraction);
        if (one_size)
            pair.normal_damping = 2 * natural * beta;
        else
            pair.damping_by_root = 2 * std::sqrt(pair.loading_stiffness) * beta;
    } else {
        pair.normal_damping = *contact.normal_damping;
        double critical = std::numeric_limits<double>::infinity();
        for (const PairSizes& t : extremes(a, b))
            critical = std::min(critical, 2 * std::sqrt(pair.loading_stiffness / t.effective_mass));
        if (pair.normal_damping >= critical && contact.attraction)
            throw UserError(
                "{}: 'normal_damping' of {:.6g} 1/s between {} is not below the critical {:.6g} "
                "1/s, so that nothing rebounds; reduce it or raise the stiffness",
                scene.where("contact.normal_damping"), pair.normal_damping, place_of_pair(a, b), critical);
        pair.restitution = linear_restitution(pair.normal_damping / (2 * natural), contact.attraction);
    }
    if (contact.tangential != TangentialLaw::linear_spring) return;
    pair.tangential_damping = contact.tangential_damping.value_or(pair.normal_damping / 2);
    if (!contact.tangential_damping) pair.tangential_damping_by_root = pair.damping_by_root / 2;
}

// Half a period (s) of the damped oscillation. An overdamped contact is longer, but nothing in it is
// faster.
double linear_contact_time(const PairPlan& pair) {
    const double natural = std::sqrt(pair.loading_stiffness / pair.effective_mass);
    const double beta = pair.damping_rate(pair.effective_mass) / (2 * natural);
    return pi / (natural * std::sqrt(std::max(0.01, 1 - beta * beta)));
}

// Hardening: e(v) = sqrt(w0 / (w0 + S v)), w0 = sqrt(K1 / m) (Walton & Braun 1986). One given point of
// e(v), at the mean effective mass, determines S; step and contact time then use e at v* of the heaviest
// pair.
void plan_hardening(const BedPlan& bed, PairPlan& pair, const PairContact& contact, const Species& a,
                    const Species* b) {
    const double natural = std::sqrt(pair.loading_stiffness / mean_effective_mass(a, b));
    const double e = contact.restitution;
    pair.hardening = natural * (1 / (e * e) - 1) / *contact.restitution_speed;
    double slowest = natural;
    for (const PairSizes& t : extremes(a, b))
        slowest = std::min(slowest, std::sqrt(pair.loading_stiffness / t.effective_mass));
    pair.restitution = std::sqrt(slowest / (slowest + pair.hardening * bed.impact_speed));
}

ContactModel contact_model(const PairContact& contact, bool corrected, Precision precision) {
    ContactModel model;
    model.precision = precision;
    model.tangential = contact.tangential;
    model.rolls = contact.rolling_friction > 0;
    if (corrected && !nearly_elastic(contact.restitution)) model.normal = NormalForce::walton_braun_corrected;
    if (contact.normal == NormalLaw::spring_dashpot) model.normal = NormalForce::spring_dashpot;
    if (contact.normal == NormalLaw::hertz) model.normal = NormalForce::hertz;
    if (contact.restitution_speed) model.normal = NormalForce::walton_braun_speed;
    if (!contact.restitution_table.empty()) model.normal = NormalForce::walton_braun_table;
    return model;
}

void plan_walton_braun(const BedPlan& bed, PairPlan& pair, const PairContact& contact, const Species& a,
                       const Species* b) {
    if (contact.restitution_speed) plan_hardening(bed, pair, contact, a, b);
    pair.restitution_table = contact.restitution_table;
    if (!pair.restitution_table.empty())
        pair.restitution = restitution_at(pair.restitution_table, bed.impact_speed);
    pair.unloading_stiffness = pair.loading_stiffness / (pair.restitution * pair.restitution);
    pair.contact_time =
        pi / 2 * (1 + pair.restitution) * std::sqrt(pair.effective_mass / pair.loading_stiffness);
    // A spring-dashpot with restitution 1 has exactly this contact time. So such grains get the same step
    // under both laws, and move the same way.
    if (pair.restitution == 1) pair.contact_time = linear_contact_time(pair);
}

// A free impact takes longer the slower it is, so the fastest (v*) limits the step.
void plan_hertz(const BedPlan& bed, PairPlan& pair, const PairContact& contact, const PairSizes& smallest) {
    pair.modulus = pair.loading_stiffness;
    const double k = 4.0 / 3 * pair.modulus * std::sqrt(smallest.effective_radius);
    const double speed = bed.impact_speed > 0 ? bed.impact_speed
                                              : std::sqrt(0.8 * k / smallest.effective_mass) *
                                                    math::pow(pair.allowed_overlap, 1.25);
    pair.loading_stiffness = pair.unloading_stiffness = 1.5 * k * std::sqrt(pair.allowed_overlap);
    pair.hertz_damping = hertz_damping(contact.restitution, contact.attraction);
    pair.contact_time = hertz_contact_time(smallest.effective_mass, k, speed);
}

}  // namespace

PairPlan plan_pair(const Scene& scene, const BedPlan& bed, const PairContact& contact, const Species& a,
                   const Species* b) {
    PairPlan pair;
    pair.model = contact_model(contact, scene.run.contact_corrections, scene.run.precision);
    const Stiffness stiffness = choose_stiffness(scene, bed, contact, a, b);
    pair.loading_stiffness = stiffness.value;
    pair.stiffness_reason = stiffness.reason;
    pair.restitution = contact.restitution;
    pair.attraction = contact.attraction;
    const PairSizes smallest = extremes(a, b).front();
    pair.effective_mass = smallest.effective_mass;
    pair.allowed_overlap = scene.run.overlap * smallest.diameter;
    switch (contact.normal) {
        case NormalLaw::walton_braun:
            plan_walton_braun(bed, pair, contact, a, b);
            break;
        case NormalLaw::spring_dashpot:
            pair.unloading_stiffness = pair.loading_stiffness;
            plan_damping(scene, pair, contact, a, b);
            pair.contact_time = linear_contact_time(pair);
            break;
        case NormalLaw::hertz:
            plan_hertz(bed, pair, contact, smallest);
            break;
    }
    if (contact.tangential == TangentialLaw::none) return pair;
    pair.friction = contact.friction;
    pair.rolling_friction = contact.rolling_friction;
    pair.tangential_ratio = contact.tangential_ratio;
    pair.tangential_stiffness = contact.tangential_ratio * pair.loading_stiffness;
    pair.gamma = contact.tangential == TangentialLaw::incremental_slip ? contact.gamma : 0;
    return pair;
}

double expected_overlap(const Scene& scene, const BedPlan& bed, const PairPlan& pair,
                        const std::vector<PairSizes>& sizes, double landing) {
    double largest = 0;
    for (const PairSizes& t : sizes) {
        const double load = std::max(t.effective_mass, landing / 3);
        double impact = bed.impact_speed * std::sqrt(load / pair.loading_stiffness) / t.diameter;
        double weight = static_load(bed, t.diameter) / pair.loading_stiffness;
        if (pair.modulus > 0) {
            const double k = 4.0 / 3 * pair.modulus * std::sqrt(t.effective_radius);
            impact = math::pow(1.25 * load * bed.impact_speed * bed.impact_speed / k, 0.4) / t.diameter;
            weight = math::pow(static_load(bed, t.diameter) * t.diameter / k, 2.0 / 3) / t.diameter;
        }
        largest = std::max({largest, impact, scene.drive.present || bed.gravity > 0 ? weight : 0.0});
    }
    return largest;
}

// What the numbers of a contact give for two grains of certain sizes, and which sizes of two species may
// meet.

namespace {

double reduced_mass(double a, double b) {
    return std::isinf(b) ? a : a * b / (a + b);
}

}  // namespace

double mass_of(const Species& species, double diameter) {
    return species.density * std::numbers::pi / 6 * diameter * diameter * diameter;
}

double restitution_at(const std::vector<RestitutionPoint>& table, double speed) {
    double e = table.front().restitution;
    for (std::size_t k = 1; k < table.size(); ++k) {
        const RestitutionPoint &low = table[k - 1], &high = table[k];
        const double share = std::clamp((speed - low.speed) / (high.speed - low.speed), 0.0, 1.0);
        e += share * (high.restitution - low.restitution);
    }
    return e;
}

double PairPlan::damping_rate(double mass) const {
    return normal_damping + damping_by_root / std::sqrt(mass);
}

double PairPlan::tangential_damping_rate(double mass) const {
    return tangential_damping + tangential_damping_by_root / std::sqrt(mass);
}

double PairPlan::restitution_of(double mass, double speed) const {
    const double natural = std::sqrt(loading_stiffness / mass);
    if (model.normal == NormalForce::spring_dashpot)
        return linear_restitution(damping_rate(mass) / (2 * natural), attraction);
    if (model.normal == NormalForce::walton_braun_speed)
        return std::sqrt(natural / (natural + hardening * speed));
    if (!restitution_table.empty()) return restitution_at(restitution_table, speed);
    return restitution;  // Hertz and a constant K2 have the same at any mass and speed
}

std::vector<PairSizes> extremes(const Species& a, const Species* b) {
    std::vector<PairSizes> all;
    for (const double first : {a.diameter.smallest, a.diameter.mean, a.diameter.largest}) {
        const double mass = mass_of(a, first);
        if (b == nullptr) {
            all.push_back({first, first / 2, mass, first / 2});
            continue;
        }
        for (const double second : {b->diameter.smallest, b->diameter.mean, b->diameter.largest})
            all.push_back({std::min(first, second), (first + second) / 2,
                           reduced_mass(mass, mass_of(*b, second)), first * second / (first + second) / 2});
    }
    return all;
}

PairSizes mean_touching(const Species& a, const Species* b) {
    const std::vector<PairSizes> sizes = extremes(a, b);
    return sizes[sizes.size() / 2];
}

double mean_effective_mass(const Species& a, const Species* b) {
    return mean_touching(a, b).effective_mass;
}

}  // namespace grainreel
