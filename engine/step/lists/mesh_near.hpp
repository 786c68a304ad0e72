// The triangles that grains near meshes may touch before the next refresh. They take the place of candidates.
// Which of them a grain touches, and in how many patches, is found anew in each step
// (find_patches() in forces/contact_forces.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
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
    // The first `flat` of these triangles lie in one plane: the nearest one and some that share an edge with
    // it. As long as the grain has moved by less than `stays` (m), it touches this plane at one place or not
    // at all. That place is on the face of the first triangle.
    std::int32_t flat;
    double stays;
    std::int32_t slots = 0;  // only patches with numbers below this may have a contact
    std::array<std::int32_t, kMostPatches> contact;  // places of its patches in the table, or kNone
    std::int32_t watched = kNone;                    // its place in ScreenWatch::grains, or kNone

    void set_contact(std::int32_t number, std::int32_t at) {
        contact[number] = at;
        slots = std::max(slots, number + 1);
    }
};
struct NearTriangle {
    std::int32_t number;
    double distance;  // m, from the grain's centre at the refresh; a little less, for rounding
};

// A fault that ends a run. Either a grain's centre came to the surface of a mesh or through it, or the grain
// touches a mesh at more patches than there are numbers.
struct MeshFault {
    enum class Kind { crossed, many_patches } kind;
    std::int32_t grain, mesh, triangle;  // id of the grain
    Vec3 position;                       // m, of its centre
    std::int64_t step = -1;
};

// The lists of one group of contacts, under one thread.
struct MeshLists {
    std::vector<MeshNear> near;  // by rising grain, then mesh
    std::vector<NearTriangle> triangles;
    std::vector<MeshTouch> touch;  // one for each contact of the table in this step, up to a whole block

    // The size of `touch` for a table of `contacts` contacts.
    static std::size_t places_for(std::int32_t contacts) {
        return static_cast<std::size_t>((contacts + kBlock - 1) / kBlock * kBlock);
    }
    void clear();
    // Lists a grain whose triangles are those within `reach` (m) of its centre, if there are any.
    void add(std::int32_t grain, std::int32_t mesh, const Surface& surface, const Vec3& centre, double reach);
    // Notes the places of the contacts in the table. Call it when all grains are listed.
    void find_contacts(const ContactTable& table);

  private:
    // All triangles of a mesh within `reach` (m) of a place in the body's frame. They serve any grain at that
    // place.
    struct Around {
        std::int32_t grain, mesh;
        Vec3 centre;
        double reach;
        std::size_t first, count;
    };
    struct Known {
        std::vector<Around> places;  // by rising grain, then mesh
        std::vector<std::int32_t> triangles;

        void clear() { places.clear(), triangles.clear(); }
    };
    const Around& around(std::int32_t grain, std::int32_t mesh, const Surface& surface, const Vec3& centre,
                         double reach);
    void find_flat(const Surface& surface, double reach, MeshNear& one) const;

    Known known_, before_;
    std::size_t next_ = 0;  // next place in before_.places
};

}  // namespace grainreel
