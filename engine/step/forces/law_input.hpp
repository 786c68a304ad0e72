// From a chunk of contacts to the input of its law: what forces are computed from (ForceInput), the patches
// of meshes that grains touch (PatchMatcher), and the rows of the chunk (law_input()). Hot: it runs for every
// chunk in each step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/laws/law_kernel.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/forces/screens.hpp"
#include "engine/step/geometry/patches.hpp"
#include "engine/step/geometry/walls.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/mesh_near.hpp"

namespace grainreel {

// Times that belong to the forces of one step. Observers, who get the forces at one instant, have zeros here.
struct ForceTimes {
    double since = 0;  // s, time since the last forces
    double ahead = 0;  // steps, from the time of the known velocity to the time of these forces
    double acts = 0;   // s, how long these forces will act
    double turns = 0;  // s: `since`, or 0 where positions and velocities belong to the same time
    double moved = 0;  // m; no grain has moved farther since the last refresh
    bool drags =
        false;  // true while grains settle or grow: a grain whose centre comes through a mesh is pushed back
};

struct ForceInput {
    const ContactRules& rules;
    const Grains& grains;
    const WallState& walls;
    const GluedGrains& glued;
    const std::vector<MeshWall>& meshes;
    ForceTimes times;
    const Screens* screens = nullptr;  // what does not count in this step; nullptr if nothing is watched
};

// Which patch of a mesh goes on with which contact of the step before.
//
// A contact goes on with the patch that has its triangle. If no patch has it, or if its normal has turned by
// more than 30 degrees, the contact goes on with the patch whose normal is nearest to its own, within 30
// degrees. If two contacts would go on with one patch, the contact with the larger force does. Patches that
// are left over become new contacts, each with the lowest free number. The result depends on the grain alone,
// not on the threads or on the order of the table.

// A patch that a grain touches now.
struct MatchedPatch {
    std::int32_t number;  // number among the grain's patches of this mesh, below kMostPatches
    bool goes_on;         // whether the contact of this number goes on with it
    MeshTouch touch;
    const Screens::Heir* heir = nullptr;  // the history of another wall's contact with which it begins
};

// Finds where a grain touches a mesh. `near` is its place in the lists; centre (m) is in the body's frame.
void find_touched(const MeshNear& near, const MeshLists& lists, const Surface& surface, const Vec3& centre,
                  double radius, Patches& patches);

class PatchMatcher {
  public:
    // Finds all patches that a grain touches, and their contacts. Most grains touch none, or one face of one
    // triangle, whose contact goes on; these cases cost little. The result is valid until the next call.
    const std::vector<MatchedPatch>& match(const ForceInput& in, const std::vector<MeshWall>& meshes,
                                           const ContactGroup& group, const MeshNear& near,
                                           const MeshLists& lists, const ContactTable& table);
    // The fault of the grain that match() was last called for, if it has one.
    const std::optional<MeshFault>& fault() const { return fault_; }

  private:
    // A contact that touched in the last step.
    struct Before {
        std::int32_t number, triangle;
        Vec3 normal;
        double force;
    };
    // A grain in the frame of a mesh's body.
    struct Asked {
        const Surface& surface;
        const WallPose& pose;
        Vec3 centre;  // m
        double radius, gone,
            reach;  // m; gone: its way since the lists were refreshed; reach: to be compared with the
                    // distances listed then
    };
    bool find_lone(const ContactGroup& group, const MeshNear& near, const MeshLists& lists,
                   const ContactTable& table, const Asked& asked);
    void find_before(const ContactGroup& group, const MeshNear& near, const ContactTable& table);
    void find_owners();
    int patch_of(const Before& before) const;
    void look_for_crossings(const ForceInput& in, const MeshNear& near, const WallPose& pose);
    void put_together(const ForceInput& in, const MeshNear& near, const WallPose& pose);

    Patches patches_;
    std::vector<Vec3> normals_;  // normals of the patches, in the frame of the scene
    std::vector<double>
        distances_;  // distances from the patches, m; negative for a centre that is to be pushed back
    std::vector<Before> before_;
    std::array<int, kMostPatches> owner_{};  // for each patch, the place of its contact in before_, or -1
    std::vector<MatchedPatch> matched_;
    std::optional<MeshFault> fault_;
};

// At most kChunk contacts, which lie side by side in arrays.
struct Chunk {
    const std::int32_t *first, *second;  // the two bodies; at a wall: grain and face
    const std::int32_t *first_at,
        *second_at;  // where to read the bodies; for grains of other threads, their copies
    int count;
    const MeshTouch* mesh = nullptr;  // where the contacts touch; for contacts with meshes only
};

// Memory for a chunk on its way through geometry, law and loads.
struct ChunkMemory {
    TouchChunk touch;
    ForceChunk force;
    RollingChunk rolling;
    std::int32_t kind[kChunk] = {};  // kinds of the chunk's contacts, where the group has several kinds
    std::int32_t face[kChunk] = {};  // faces to which the glued grains belong
    Ahead ahead;
    PatchMatcher matcher;
    Screens screens;
};

// Computes the geometry of the chunk into memory.touch, in floats if `rounded`. Returns the input of its law.
LawInput law_input(const ForceInput& in, const ContactGroup& group, const Chunk& chunk, bool rounded,
                   ChunkMemory& memory);

// Whether all contacts of a chunk have the same parameters.
inline bool are_of_one_kind(const ContactGroup& group, const LawInput& in) {
    if (!group.needs_rows()) return true;
    std::int32_t others = 0;
    for (int c = 0; c < in.count; ++c) others |= in.kind[c] ^ in.kind[0];
    return others == 0;
}

// Resistance to rolling is the second law of a chunk. In each block of the history its numbers come after
// those of the first law.
inline LawInput for_rolling(const ContactGroup& group, LawInput in) {
    in.parameters = &group.rolling_parameters;
    return in;
}
template <class History>
History* behind_law(const ContactGroup& group, History* history) {
    using Byte = std::conditional_t<std::is_const_v<History>, const std::byte, std::byte>;
    return static_cast<Byte*>(history) + kBlock * group.number_size() * group.law->history_size;
}

}  // namespace grainreel
