// Which contact follows which law. Contacts of one law form a group with lists of its own, and each group
// runs through one kernel. So walls without friction do not take the time of friction, even if the grains
// have friction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// A grain may touch a mesh at several patches of its surface. The second body of such a contact is the patch,
// numbered mesh x kMostPatches + n, where n is below kMostPatches and differs between the patches of a grain.
constexpr std::int32_t kMostPatches = 8;
inline std::int32_t mesh_of(std::int32_t patch) {
    return patch / kMostPatches;
}

// Numbers that a contact with a mesh remembers after the numbers of its laws: the triangle that it touched,
// the normal and the normal force (N), all in the last step. Checkpoints hold them in this order.
enum PatchNumber { kTriangle, kNormalX, kNormalY, kNormalZ, kForce, kPatchNumbers };

// A group of contacts that follow one law. It may hold several kinds of contact. A kind of contact between
// grains is a pair of species, numbered first x species + second. A kind of contact with walls, or with
// grains glued to them, is a species. A kind of contact with meshes is numbered mesh x species + species of
// the grain.
struct ContactGroup {
    ContactModel model;
    const LawKernel* law;
    const LawKernel* rolling;  // nullptr: no resistance to rolling
    bool of_pairs;
    bool of_glued;  // true for contacts of grains with glued grains
    bool of_mesh;   // true for contacts of grains with patches of meshes
    LawParameters parameters, rolling_parameters;
    std::vector<std::int32_t> row;  // place of each kind in the parameters

    std::size_t number_size() const { return law->number_size; }
    // Numbers in the history of a contact: the numbers of the laws, then those that a patch of a mesh
    // remembers.
    int law_size() const { return law->history_size + (rolling ? rolling->history_size : 0); }
    int history_size() const { return law_size() + (of_mesh ? kPatchNumbers : 0); }
    bool turns(int number) const;  // whether this number of the history changes sign when bodies swap places
    bool needs_rows() const { return parameters.kinds > 1; }
};

struct ContactRules {
    std::vector<ContactGroup> groups;  // groups of pairs first, then of walls, of glued grains, of meshes
    std::vector<std::int32_t> group_of_pair, group_of_wall, group_of_glued,
        group_of_mesh;  // one for each kind
    std::int32_t species;
    LeverArms arms;
    double period;    // m, of x; 0 for none
    bool rubs;        // whether any contact has friction
    bool rounds;      // whether any law of pairs reads Grains::rounded
    bool has_floats;  // whether any law computes with floats

    ContactRules(const Plan& plan, double period_of_x);
    bool one_group_of_pairs() const { return groups.size() < 2 || !groups[1].of_pairs; }
    std::size_t group_of(std::int32_t mesh, std::int32_t of_species) const {
        return static_cast<std::size_t>(group_of_mesh[mesh * species + of_species]);
    }
};

}  // namespace grainreel
