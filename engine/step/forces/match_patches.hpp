// Which patch of a mesh goes on with which contact of the step before.
//
// A contact goes on with the patch that has its triangle, unless the normal has jumped; else with the patch
// whose normal is nearest to its own. Where two contacts would go on with one patch, the one with the larger
// force does. What is left over are new contacts; each takes the lowest number that is free. All this depends
// on the grain alone, and not on threads, nor on the order of the table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/step/forces/force_input.hpp"
#include "engine/step/geometry/patches.hpp"
#include "engine/step/lists/mesh_near.hpp"

namespace grainreel {

// A patch that a grain touches now.
struct MatchedPatch {
    std::int32_t number;  // of the grain's patches of this mesh, below kMostPatches
    bool goes_on;         // with the contact of this number
    MeshTouch touch;
};

class PatchMatcher {
  public:
    // Finds all patches that a grain touches, and their contacts. Mostly it is none, or one face of one
    // triangle, whose contact goes on: these cost little. Valid until the next call.
    const std::vector<MatchedPatch>& match(const ForceInput& in, const std::vector<MeshWall>& meshes,
                                           const ContactGroup& group, const MeshNear& near,
                                           const MeshLists& lists, const ContactTable& table);
    // What is wrong with the grain that was asked for last, if anything is.
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
        Vec3 centre;                 // m
        double radius, gone, reach;  // m; gone: since the refresh; reach: of triangles as they were then
    };
    bool find_lone(const ContactGroup& group, const MeshNear& near, const MeshLists& lists,
                   const ContactTable& table, const Asked& asked);
    void find_before(const ContactGroup& group, const MeshNear& near, const ContactTable& table);
    void find_owners();
    int patch_of(const Before& before) const;
    void look_for_crossings(const ForceInput& in, const MeshNear& near, const WallPose& pose);
    void put_together(const WallPose& pose);

    Patches patches_;
    std::vector<Vec3> normals_;      // of the patches, in the frame of the scene
    std::vector<double> distances_;  // likewise, m; negative for a centre that is to be pushed back
    std::vector<Before> before_;
    std::array<int, kMostPatches> owner_{};  // of each patch: which of before_; -1 for none
    std::vector<MatchedPatch> matched_;
    std::optional<MeshFault> fault_;
};

}  // namespace grainreel
