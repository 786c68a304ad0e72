// A mesh that grains can touch: its triangles with their neighbours, and a tree of boxes to find those that are
// near. It is made once and never changes. All lengths are in the body's frame, which is the scene at rest.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/mesh_facts.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// Where a point is nearest to a triangle: on its face, on one of its edges (edge e runs from corner e to corner
// e + 1), or at a corner.
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
    // flat: the planes differ by less than 1e-6. smooth: by less than kSmoothAngle. Else seen from the side of
    // the normal; a smooth edge says nothing of convex or concave.
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
        return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[static_cast<std::size_t>(triangle)][k])];
    }
    const Vec3& normal(std::int32_t triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
    double area(std::int32_t triangle) const;  // m2
    const Neighbour& neighbour(std::int32_t triangle, int edge) const {
        return neighbours_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(edge)];
    }

    NearestPoint nearest(std::int32_t triangle, const Vec3& point) const;
    // The nearest point of all triangles within `reach` (m); of equal ones that with the lowest number.
    struct Nearest {
        std::int32_t triangle;
        NearestPoint point;
    };
    std::optional<Nearest> nearest(const Vec3& point, double reach) const;
    // Appends all triangles within `reach` (m) of the point, by rising number.
    void near(const Vec3& point, double reach, std::vector<std::int32_t>& found) const;
    bool any_within(const Vec3& point, double reach) const;

    // The first triangle that a ray meets, and how far away (m); direction: unit.
    struct Hit {
        std::int32_t triangle;
        double distance;
    };
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;
    // All crossings of a ray, by rising distance. A ray through an edge counts as one through its neighbour
    // (crossings are decided exactly, triangle by triangle, so that none is lost or doubled).
    void all_hits(const Vec3& from, const Vec3& direction, std::vector<Hit>& hits) const;

    // m, the largest distance of any vertex from an axis through a point, and from the point itself.
    double farthest_from_axis(const Vec3& through, const Vec3& axis) const;
    double farthest_from(const Vec3& point) const;

  private:
    struct Box {
        Eigen::AlignedBox3d box;
        std::int32_t first = 0, count = 0;  // triangles in order_, or of a parent: count 0, children at first
    };
    TriangleMesh mesh_;
    MeshFacts facts_;
    std::string hash_;
    std::vector<Vec3> normals_;
    std::vector<std::array<Neighbour, 3>> neighbours_;
    std::vector<Box> boxes_;
    std::vector<std::int32_t> order_;
};

}  // namespace grainreel
