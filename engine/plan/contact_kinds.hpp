// The kinds of contact that a run can have: which species can meet each other or a wall, and which share of
// the contacts each kind has. Messages speak of the commonest kinds, and name the kind that is extreme.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct ContactKind {
    std::string name;      // "\"nut\" and \"bead\"", "\"nut\" and a wall", "\"nut\" and \"drum\""
    const PairPlan* pair;  // lives as long as the plan
    Species first;
    std::optional<Species> second;  // empty for a wall or a mesh; a glued grain has infinite density
    bool at_wall = false;           // a wall, a mesh, or what is glued to a wall
    // Share of all contacts between grains, or, at a wall, of the contacts at that wall. It is estimated: a
    // grain has contacts in proportion to its surface.
    double share = 0;

    const Species* other() const { return second ? &*second : nullptr; }
    double mean_contact_time() const;  // s, between grains of mean size
    double smaller_diameter() const;   // m, the mean diameter of the smaller species
};

// There is no kind for a species of a single grain with itself, none for a species without free grains, and
// no kind "a wall" where the scene has neither a container with faces nor a plane.
std::vector<ContactKind> contact_kinds(const Scene& scene, const Plan& plan);

// Share of all contacts between grains that each species has; 0 for a species that is only glued to walls.
std::vector<double> contact_shares(const Scene& scene);

// The smallest and the largest restitution of a free impact at the plan's impact speed, among the smallest
// and largest grains of the two species. b is nullptr for a wall.
struct RestitutionRange {
    double low = 1, high = 0;
};
RestitutionRange restitution_range(const Plan& plan, const PairPlan& pair, const Species& a,
                                   const Species* b);

}  // namespace grainreel
