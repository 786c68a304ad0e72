// The nearest point of one triangle.
#include <algorithm>

#include "engine/mesh/surface.hpp"

namespace grainreel {
namespace {

// A triangle with its corners at hand.
struct Corners {
    const TriangleMesh::Triangle& numbers;
    const Vec3* at[3];
};

std::size_t after(std::size_t k) {
    return k == 2 ? 0 : k + 1;
}

// On edge e, worked out from the vertex of the lower number, so that both triangles find the same.
NearestPoint nearest_on_edge(const Corners& corners, std::size_t e, const Vec3& point) {
    const std::size_t f = after(e);
    const bool back = corners.numbers[e] > corners.numbers[f];
    const Vec3 &begin = *corners.at[back ? f : e], &end = *corners.at[back ? e : f];
    const Vec3 along = end - begin;
    const double t = along.dot(point - begin) / along.squaredNorm();
    NearestPoint found{begin, 0, static_cast<Feature>(4 + (back ? f : e))};
    if (t >= 1) {
        found.at = end;
        found.feature = static_cast<Feature>(4 + (back ? e : f));
    } else if (t > 0) {
        found.at = begin + t * along;
        found.feature = static_cast<Feature>(1 + e);
    }
    found.squared = (point - found.at).squaredNorm();
    return found;
}

}  // namespace

// Where the foot of the perpendicular is outside, the nearest point lies on an edge that the foot is outside
// of. No quotient of areas is formed, as C. Ericson, Real-Time Collision Detection (2005), 5.1.5 does: on
// slender triangles it says nothing. Of those the sides alone decide, and to within their height all is
// right.
NearestPoint Surface::nearest(std::int32_t triangle, const Vec3& point) const {
    const TriangleMesh::Triangle& numbers = mesh_.triangles[static_cast<std::size_t>(triangle)];
    Corners corners{numbers, {}};
    for (std::size_t k = 0; k < 3; ++k) corners.at[k] = &mesh_.vertices[static_cast<std::size_t>(numbers[k])];
    const Vec3& n = normal(triangle);
    const Vec3 to[3] = {point - *corners.at[0], point - *corners.at[1], point - *corners.at[2]};
    NearestPoint best{point, -1, Feature::face};
    for (std::size_t e = 0; e < 3; ++e) {
        // n . (edge x way to the point), where the edge is the difference of two ways.
        if (!(n.dot(to[e].cross(to[after(e)])) < 0)) continue;
        const NearestPoint here = nearest_on_edge(corners, e, point);
        if (best.squared < 0 || here.squared < best.squared) best = here;
    }
    if (best.squared >= 0) return best;
    const double distance = n.dot(to[0]);
    return {point - distance * n, distance * distance, Feature::face};
}

// The edges' tests above are heights over the edges, times their lengths.
double Surface::stays_on_face(std::int32_t triangle, const Vec3& point) const {
    constexpr double kRounding = 1e-13, kLess = 1 - 1e-9;
    const Vec3& n = normal(triangle);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < 3; ++e) {
        const Vec3 to = point - corner(triangle, e), on = point - corner(triangle, e == 2 ? 0 : e + 1);
        const double height = n.dot(to.cross(on)) - kRounding * to.norm() * on.norm();
        const double stays = height / (on - to).norm();
        if (!(stays > 0)) return -1;
        least = std::min(least, stays);
    }
    return kLess * least;
}

}  // namespace grainreel
