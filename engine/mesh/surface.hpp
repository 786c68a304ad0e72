// A mesh that grains can touch: its triangles with their neighbours, and a tree of boxes to find triangles
// near a place. It is made once and never changes. All coordinates are in the body's frame, which is the
// scene's before anything moves.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/nearest_point.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/mesh/mesh_facts.hpp"

namespace grainreel {

// The neighbour of a triangle beyond one of its edges.
struct Neighbour {
    enum class Turn : std::uint8_t { flat, smooth, convex, concave };
    std::int32_t triangle = -1;  // -1 at an open edge, or at an edge of more than two triangles
    // flat: the planes differ by less than 1e-6 rad. smooth: they differ by less than kSmoothAngle, either
    // way. convex, concave: other edges, as seen from the side of the normal. A sheet folded back is convex.
    Turn turn = Turn::flat;
    bool flips = false;  // the neighbour's normal points to the other side (surfaces that cannot be oriented)
};

// Angle in rad. Neighbours that turn less belong to one patch, so that a drum of 36 or more facets is round.
inline constexpr double kSmoothAngle = 10.5 * 3.14159265358979323846 / 180;

class Surface {
  public:
    Surface(TriangleMesh mesh, MeshFacts facts, std::string hash);

    const TriangleMesh& mesh() const { return mesh_; }
    const MeshFacts& facts() const { return facts_; }
    const std::string& hash() const {
        return hash_;
    }  // hash of file and placement; equal surfaces have equal hashes
    std::int32_t size() const { return static_cast<std::int32_t>(mesh_.triangles.size()); }

    const Vec3& corner(std::int32_t triangle, int k) const {
        return mesh_.vertices[mesh_.triangles[triangle][k]];
    }
    const Vec3& normal(std::int32_t triangle) const { return normals_[triangle]; }
    double area(std::int32_t triangle) const;  // m2
    const Neighbour& neighbour(std::int32_t triangle, int edge) const { return neighbours_[triangle][edge]; }

    // The point of a triangle nearest to `point`. On the face it is the foot of the perpendicular. On a
    // shared edge both triangles give the same bits, and at a corner it is the vertex itself. On a slender
    // triangle it is right to within the triangle's height.
    NearestPoint nearest(std::int32_t triangle, const Vec3& point) const;
    // The nearest point of all triangles within `reach` (m). Among equally near triangles, the lowest number
    // counts.
    struct Nearest {
        std::int32_t triangle;
        NearestPoint point;
    };
    std::optional<Nearest> nearest(const Vec3& point, double reach) const;
    // Distance (m) by which a point may move in any direction while its nearest point stays on the triangle's
    // face. It is a little too small, for rounding, and below 0 if the nearest point is not on the face.
    double stays_on_face(std::int32_t triangle, const Vec3& point) const;
    // Appends all triangles within `reach` (m) of the point, by rising number.
    void near(const Vec3& point, double reach, std::vector<std::int32_t>& found) const;
    bool any_within(const Vec3& point, double reach) const;

    // A crossing of a ray and a triangle; `direction` is unit and `distance` is in m. Exact signs decide
    // about crossings. A ray through an edge or a vertex counts as passing it on a fixed side, so with a
    // closed surface no crossing is lost or doubled.
    struct Hit {
        std::int32_t triangle;
        double distance;
        bool front = false;  // true if the ray comes from the side to which the normal points
    };
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;
    // Appends all crossings, by rising distance.
    void all_hits(const Vec3& from, const Vec3& direction, std::vector<Hit>& hits) const;
    // Whether the ray crosses any triangle within `reach` (m).
    bool meets(const Vec3& from, const Vec3& direction,
               double reach = std::numeric_limits<double>::infinity()) const;

    // Appends the triangles that reach from below the height z (m) to this height or above it.
    void across_level(double z, std::vector<std::int32_t>& found) const;

    // The largest distance (m) of any vertex from an axis through a point, and from a point.
    double farthest_from_axis(const Vec3& through, const Vec3& axis) const;
    double farthest_from(const Vec3& point) const;

  private:
    // A node of the tree, which fills one line of the cache. A node with count 0 is a parent with two
    // children, first and first + 1. Any other node is a leaf with the `count` triangles from order_[first]
    // on.
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
