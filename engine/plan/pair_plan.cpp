// What the numbers of a contact mean for two grains of given size, and which sizes of a species meet.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/plan/damping.hpp"
#include "engine/plan/plan_parts.hpp"

namespace grainreel {
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
    return restitution;  // of Hertz and of a constant K2: at any mass and speed
}

std::vector<Touching> extremes(const Species& a, const Species* b) {
    std::vector<Touching> all;
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

Touching mean_touching(const Species& a, const Species* b) {
    const std::vector<Touching> sizes = extremes(a, b);
    return sizes[sizes.size() / 2];
}

double mean_effective_mass(const Species& a, const Species* b) {
    return mean_touching(a, b).effective_mass;
}

}  // namespace grainreel
