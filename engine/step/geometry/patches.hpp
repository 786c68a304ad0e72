// Finds where a grain touches a mesh. There is one contact for each connected patch of the surface within the
// grain's reach, however the surface is cut into triangles.
//
// A triangle touches when its nearest point is closer to the grain's centre than the radius. Touching
// triangles belong to one patch if they meet in their nearest point, or in an edge that is flat, smooth (the
// planes differ by less than kSmoothAngle) or convex as seen from the centre. The patch is touched at its
// nearest point, if the distance to the surface has a local minimum there. On a face it always has one. On an
// edge or a corner it has one if no triangle at this edge or corner is nearer to the centre. So a ball in a
// groove has two contacts, and a ball on one wall of the groove does not touch the groove's edge.
//
// Two rules make one wall of pieces that do not share their edges, and of the two sides of a thin plate. They
// hold between meshes too (forces/screens.hpp). Of two places whose normals differ by less than kSmoothAngle
// only the nearer one counts. A place counts only if nothing lies before it: no other part of the surface on
// the straight way from the centre, and not the plane of a nearer place on a face.
//
// All values are in the body's frame and in doubles. The answer does not depend on the order of the
// triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/nearest_point.hpp"
#include "engine/base/vector.hpp"

namespace grainreel {

class Surface;  // engine/mesh/surface.hpp

struct Patch {
    std::int32_t triangle;  // the triangle that has the nearest point; among equals a face comes before an
                            // edge and an edge before a corner, then the lowest number counts
    Vec3 at;                // m, the nearest point
    Vec3 normal;            // unit, from the centre to it
    double distance;  // m, of the centre; 0 if the centre lies in the surface, and `normal` is then that of
                      // the triangle
    bool on_face;     // whether the place is on the triangle's face, not on an edge or a corner
};

// A place where a grain touches something, for the rules above.
struct TouchedPlace {
    Vec3 normal;      // unit, from the grain's centre
    double distance;  // m
    bool on_face;
};
// Whether the nearer of two places of a grain of this radius (m) counts in place of the other, as far as
// their normals and the nearer one's plane say.
bool stands_for(const TouchedPlace& nearer, const TouchedPlace& other, double radius);

class Patches {
  public:
    // Forgets the last grain. Call add() for each triangle that may touch, in any order, then find().
    void begin(const Surface& surface, const Vec3& centre, double radius);
    void add(std::int32_t triangle);
    void find();

    // The patches, by rising triangle.
    const std::vector<Patch>& all() const { return patches_; }
    // Number of the patch that a triangle belongs to; -1 if the triangle or its patch does not touch. Where a
    // nearer patch with the same normal counts in place of its own, it is the number of that one.
    int holder_of(std::int32_t triangle) const;
    // Leaves out the patch that has this triangle, if there is one.
    void leave_out(std::int32_t triangle);

  private:
    // Triangles that are joined make a group. A group becomes a patch if its nearest point is a local
    // minimum.
    struct Touching {
        std::int32_t triangle;
        int group;     // place in touching_: of another member of its group, or its own
        double plane;  // m, of the centre from the triangle's plane, positive on the normal's side
        NearestPoint nearest;
        int patch = -1;
    };
    int place_of(std::int32_t triangle) const;
    int group_of(int t);
    bool are_one_group();
    void join(int one, int other);
    void join_over_edges(int t);
    bool is_one_patch_over(int t, int edge, int other) const;
    bool is_minimum(int t);
    bool comes_before(const Touching& one, const Touching& other, double least) const;
    void add_patch(int group, int best);
    void keep_those_that_count();
    bool is_free(const Patch& patch) const;
    void renumber(const std::vector<int>& heir);

    const Surface* surface_ = nullptr;
    Vec3 centre_{0, 0, 0};
    double radius_ = 0, squared_reach_ = 0;  // m, m2
    std::vector<Touching> touching_;         // by rising triangle, once they are found
    std::vector<int> best_;  // place of each group's nearest member; it stands where the first member does
    std::vector<double> least_;  // m2, least squared distance of each group; it stands there too
    std::vector<Patch> patches_;
    std::vector<int> heir_;  // for each patch, the one that counts in its place: itself, a nearer one, or -1
};

}  // namespace grainreel
