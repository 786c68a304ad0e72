// The triangles that grains near meshes may touch before the next refresh. They take the place of candidates:
// which of them a grain touches, and in how many patches, is found anew in each step
// (forces/mesh_contacts.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/step/geometry/patches.hpp"
#include "engine/step/geometry/wall_point.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/contact_table.hpp"

namespace grainreel {

// A grain near a mesh.
struct MeshNear {
    static constexpr std::int32_t kNone = -1;

    std::int32_t grain, mesh;
    Vec3 centre;                // m, of the grain at the refresh, in the body's frame
    std::int32_t first, count;  // its triangles; the nearest comes first
    std::array<std::int32_t, kMostPatches>
        contact;  // where its patches stand in the table; kNone for nowhere
};
struct NearTriangle {
    std::int32_t number;
    double distance;  // m, of the grain's centre at the refresh; a little less, for rounding
};

// What ends a run: a grain's centre came to the surface of a mesh or through it, or it touches a mesh at more
// patches than there are numbers.
struct MeshFault {
    enum class Kind { crossed, many_patches } kind;
    std::int32_t grain, mesh, triangle;  // id of the grain
    Vec3 position;                       // m, of its centre
    std::int64_t step = -1;
};

// Of one group of contacts under one thread.
struct MeshLists {
    std::vector<MeshNear> near;  // by rising grain, then mesh
    std::vector<NearTriangle> triangles;
    std::vector<MeshTouch> touch;  // of each contact of the table, in this step

    void clear() { near.clear(), triangles.clear(), touch.clear(); }
    // Lists a grain whose triangles are those within `reach` (m) of its centre, if there are any.
    void add(std::int32_t grain, std::int32_t mesh, const Surface& surface, const Vec3& centre, double reach);
    // Notes where the contacts stand in the table. Call it when all grains are listed.
    void find_contacts(const ContactTable& table);

  private:
    std::vector<std::int32_t> found_;
};

}  // namespace grainreel
