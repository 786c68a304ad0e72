// A mesh that grains can touch: its triangles with their neighbours, and a tree of boxes to find those that
// are near. It is made once and never changes. All lengths are in the body's frame, which is the scene at
// rest.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// Where a point is nearest to a triangle: on its face, on one of its edges (edge e runs from corner e to
// corner e + 1), or at a corner.
enum class Feature : std::uint8_t { face, edge0, edge1, edge2, corner0, corner1, corner2 };
struct NearestPoint {
    Vec3 at;         // m
    double squared;  // m2, from the point asked for
    Feature feature;
};

// What lies beyond one edge of a triangle.
struct Neighbour {
    enum class Turn : std::uint8_t { flat, smooth, convex, concave };
    std::int32_t triangle = -1;  // -1: an open edge, or an edge of more than two triangles
    // flat: the planes differ by less than 1e-6 rad. smooth: by less than kSmoothAngle. Else seen from the
    // side of the normal; a smooth edge says nothing of convex or concave. A sheet folded back is convex.
    Turn turn = Turn::flat;
    bool flips = false;  // the neighbour's normal points to the other side (surfaces that cannot be oriented)
};

// rad; neighbours that turn less are one patch, so that a drum of 36 facets and more is round.
inline constexpr double kSmoothAngle = 10.5 * 3.14159265358979323846 / 180;

class Surface {
  public:
    Surface(TriangleMesh mesh, MeshFacts facts, std::string hash);

    const TriangleMesh& mesh() const { return mesh_; }
    const MeshFacts& facts() const { return facts_; }
    const std::string& hash() const { return hash_; }  // of file and placement: equal surfaces are alike
    std::int32_t size() const { return static_cast<std::int32_t>(mesh_.triangles.size()); }

    const Vec3& corner(std::int32_t triangle, int k) const {
        return mesh_
            .vertices[static_cast<std::size_t>(mesh_.triangles[static_cast<std::size_t>(triangle)][k])];
    }
    const Vec3& normal(std::int32_t triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
    double area(std::int32_t triangle) const;  // m2
    const Neighbour& neighbour(std::int32_t triangle, int edge) const {
        return neighbours_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(edge)];
    }

    // On the face it is the foot of the perpendicular. On an edge that two triangles share both give the same
    // bits, and a corner is the vertex itself. On a slender triangle it is right to within its height.
    NearestPoint nearest(std::int32_t triangle, const Vec3& point) const;
    // The nearest point of all triangles within `reach` (m); of equal ones that with the lowest number.
    struct Nearest {
        std::int32_t triangle;
        NearestPoint point;
    };
    std::optional<Nearest> nearest(const Vec3& point, double reach) const;
    // m, how far a point may move, in any direction, while its nearest point stays on the triangle's face. A
    // little less, for rounding; below 0 where it is not on the face.
    double stays_on_face(std::int32_t triangle, const Vec3& point) const;
    // Appends all triangles within `reach` (m) of the point, by rising number.
    void near(const Vec3& point, double reach, std::vector<std::int32_t>& found) const;
    bool any_within(const Vec3& point, double reach) const;

    // Where a ray crosses a triangle, and how far away (m); direction: unit. Crossings are decided by exact
    // signs, and a ray through an edge or a vertex as one that passes it on a fixed side: through a closed
    // surface none is lost and none doubled.
    struct Hit {
        std::int32_t triangle;
        double distance;
        bool front = false;  // the ray comes from the side to which the normal points
    };
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;
    // All crossings, by rising distance; appended.
    void all_hits(const Vec3& from, const Vec3& direction, std::vector<Hit>& hits) const;
    // Whether it crosses any, within `reach` (m).
    bool meets(const Vec3& from, const Vec3& direction,
               double reach = std::numeric_limits<double>::infinity()) const;

    // Appends the triangles that reach from below that height (m) to it or above.
    void across_level(double z, std::vector<std::int32_t>& found) const;

    // m, the largest distance of any vertex from an axis through a point, and from the point itself.
    double farthest_from_axis(const Vec3& through, const Vec3& axis) const;
    double farthest_from(const Vec3& point) const;

  private:
    // A node of the tree, one line of the cache. count 0: a parent, with its two children at first and first
    // + 1; else a leaf: order_[first] and those behind it.
    struct alignas(64) Node {
        Eigen::AlignedBox3d box;
        std::int32_t first = 0, count = 0;
    };
    static constexpr std::size_t kDeepest = 64;  // the tree is balanced: 31 levels at most

    void find_normals();
    void find_neighbours();
    void build_tree();
    template <class Within>
    void visit(const Vec3& point, double squared_reach, Within&& within) const;
    template <class Met>
    void visit_ray(const Vec3& from, const Vec3& direction, double reach, Met&& met) const;

    TriangleMesh mesh_;
    MeshFacts facts_;
    std::string hash_;
    std::vector<Vec3> normals_;
    std::vector<std::array<Neighbour, 3>> neighbours_;
    std::vector<Node> nodes_;
    std::vector<std::int32_t> order_;
};

}  // namespace grainreel
