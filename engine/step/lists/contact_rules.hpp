// Which contact follows which law. Contacts of one law form a group with lists of its own, and each group
// runs through one kernel. So a wall without friction costs no friction, even where the grains have some.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// A group of contacts that follow one law. It may hold several kinds of contact. A kind of contact between
// grains is a pair of species, numbered first x species + second. A kind of contact with walls, or with
// grains glued to them, is a species.
struct ContactGroup {
    ContactModel model;
    const LawKernel* law;
    const LawKernel* rolling;  // nullptr: no resistance to rolling
    bool of_pairs;
    bool of_glued;  // of grains with glued grains
    LawParameters parameters, rolling_parameters;
    std::vector<std::int32_t> row;  // where each kind stands in the parameters

    std::size_t number_size() const { return law->number_size; }
    int history_size() const { return law->history_size + (rolling ? rolling->history_size : 0); }
    bool turns(int number) const;  // whether this number of the history changes sign when bodies swap places
    bool needs_rows() const { return parameters.kinds > 1; }
};

struct ContactRules {
    std::vector<ContactGroup> groups;  // those of pairs first, those of glued grains last
    std::vector<std::int32_t> group_of_pair, group_of_wall, group_of_glued;  // the group of each kind
    std::int32_t species;
    LeverArms arms;
    double period;  // m, of x; 0 for none
    bool rubs;      // whether any contact has friction
    bool rounds;    // whether any law of pairs reads Grains::rounded

    ContactRules(const Plan& plan, double period_of_x);
    bool one_group_of_pairs() const { return groups.size() < 2 || !groups[1].of_pairs; }
};

}  // namespace grainreel
