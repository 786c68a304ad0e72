#include "engine/plan/contact_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/mathematics.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

// The plan holds the contact time of the smallest grains. That of mean grains is longer: for a linear
// spring it grows as the root of the mass, for Hertz' as (m / k)^(2/5), where k grows as the root of the
// radius (hertz_contact_time).
double ContactKind::mean_contact_time() const {
    const PairSizes smallest = extremes(first, other()).front(), mean = mean_touching(first, other());
    const double heavier = mean.effective_mass / smallest.effective_mass;
    if (pair->modulus == 0) return pair->contact_time * std::sqrt(heavier);
    return pair->contact_time *
           math::pow(heavier / std::sqrt(mean.effective_radius / smallest.effective_radius), 0.4);
}

double ContactKind::smaller_diameter() const {
    return second ? std::min(first.diameter.mean, second->diameter.mean) : first.diameter.mean;
}

std::vector<double> contact_shares(const Scene& scene) {
    std::vector<double> shares;
    for (const Species& s : scene.species)
        shares.push_back(static_cast<double>(s.all()) * s.diameter.mean * s.diameter.mean);
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& one : shares) one = all > 0 ? one / all : 0;
    return shares;
}

std::vector<ContactKind> contact_kinds(const Scene& scene, const Plan& plan) {
    const std::vector<double> shares = contact_shares(scene);
    const Container::Shape shape = scene.container.shape;
    const bool faces = shape != Container::Shape::none && shape != Container::Shape::mesh;
    const bool walls = faces || !scene.walls.empty();
    std::vector<ContactKind> kinds;
    double of_grains = 0;
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        const Species& first = scene.species[a];
        if (first.all() == 0) continue;
        for (std::size_t b = a; b < scene.species.size(); ++b) {
            const Species& second = scene.species[b];
            if (second.all() == 0 || (a == b && first.all() == 1)) continue;
            const double part = shares[a] * shares[b] * (a == b ? 1 : 2);
            kinds.push_back({fmt::format("\"{}\" and \"{}\"", first.name, second.name), &plan.between(a, b),
                             first, second, false, part});
            of_grains += part;
        }
        const std::string name = fmt::format("\"{}\" and ", first.name);
        if (walls) kinds.push_back({name + "a wall", &plan.wall[a], first, std::nullopt, true, shares[a]});
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            kinds.push_back({fmt::format("{}\"{}\"", name, scene.meshes[m].name), &plan.at_mesh(m, a), first,
                             std::nullopt, true, shares[a]});
        if (!plan.glued.empty())
            kinds.push_back(
                {name + "a glued grain", &plan.glued[a], first, glued_species(scene), true, shares[a]});
    }
    for (ContactKind& kind : kinds)
        if (!kind.at_wall) kind.share /= of_grains;
    return kinds;
}

RestitutionRange restitution_range(const Plan& plan, const PairPlan& pair, const Species& a,
                                   const Species* b) {
    RestitutionRange range;
    for (const PairSizes& t : extremes(a, b)) {
        const double e = pair.restitution_of(t.effective_mass, plan.impact_speed);
        range = {std::min(range.low, e), std::max(range.high, e)};
    }
    return range;
}

}  // namespace grainreel
