// Which contact follows which law: contacts of one law form a group, so that each list runs through one
// kernel, and a wall without friction costs none though the grains have some.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// A kind of contact is a pair of species (first x species + second), or a species and a wall (its number).
struct ContactGroup {
    ContactModel model;
    const LawKernel* law;
    const LawKernel* rolling;  // nullptr where rolling meets no resistance
    bool of_pairs;
    LawParameters parameters, rolling_parameters;
    std::vector<std::int32_t> row;  // of each kind in the parameters

    std::size_t number_size() const { return law->number_size; }
    int history_size() const { return law->history_size + (rolling ? rolling->history_size : 0); }
    bool turns(int number) const;  // of the history: changes sign when the bodies change places
    bool needs_rows() const { return parameters.kinds > 1; }
};

struct ContactRules {
    std::vector<ContactGroup> groups;                        // those of pairs first
    std::vector<std::int32_t> group_of_pair, group_of_wall;  // of each kind
    std::int32_t species;
    LeverArms arms;
    double period;  // m, of x; 0 for none
    bool rubs;      // any contact does
    bool rounds;    // any law of pairs takes Grains::rounded

    ContactRules(const Plan& plan, double period_of_x);
    bool one_group_of_pairs() const { return groups.size() < 2 || !groups[1].of_pairs; }
};

}  // namespace grainreel
