#include "engine/files/foreign/mercury/plane_in_box.hpp"

#include <cmath>
#include <vector>

namespace grainreel {

namespace {

using Polygon = std::vector<Vec3>;

// The part of a polygon where x·way <= most (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const Vec3& way, double most) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double from = way.dot(a) - most, to = way.dot(b) - most;
        if (from <= 0) kept.push_back(a);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) kept.push_back(a + (b - a) * (from / (from - to)));
    }
    return kept;
}

// The part of a polygon in the box. `slack` keeps a polygon on a face of the box, which may lie outside by
// rounding.
Polygon cut_to(Polygon polygon, const Vec3& low, const Vec3& high) {
    const double slack = 1e-9 * (high - low).norm();
    for (int axis = 0; axis < 3; ++axis) {
        polygon = cut(polygon, Vec3::Unit(axis), high[axis] + slack);
        polygon = cut(polygon, -Vec3::Unit(axis), -low[axis] + slack);
    }
    for (Vec3& corner : polygon) corner = corner.cwiseMax(low).cwiseMin(high);
    return polygon;
}

}  // namespace

TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box) {
    TriangleMesh mesh;
    const Vec3 low = box.origin, high = box.origin + box.edges[0] + box.edges[1] + box.edges[2];
    const double size = (high - low).norm();
    if (!(outwards.norm() > 0) || !(size > 0) || !place.allFinite()) return mesh;
    const Vec3 normal = outwards.normalized();
    const Vec3 middle = 0.5 * (low + high);
    const Vec3 foot = middle + normal * normal.dot(place - middle);
    int axis = 0;
    normal.cwiseAbs().minCoeff(&axis);
    const Vec3 u = normal.cross(Vec3::Unit(axis)).normalized(), v = u.cross(normal);
    const Polygon large{foot - size * u - size * v, foot + size * u - size * v, foot + size * u + size * v,
                        foot - size * u + size * v};
    Polygon polygon = cut_to(large, low, high);
    if (polygon.size() < 3) {  // the plane is outside the box: it is cut at the box's end and moved back
        const double reach = 0.5 * normal.cwiseAbs().dot(high - low);
        const double away = normal.dot(foot - middle);
        const Vec3 shift = normal * (std::copysign(reach * (1 - 1e-9), away) - away);
        polygon.clear();
        for (const Vec3& corner : large) polygon.push_back(corner + shift);
        polygon = cut_to(polygon, low, high);
        for (Vec3& corner : polygon) corner -= shift;
    }
    if (polygon.size() < 3) return mesh;
    mesh.vertices = polygon;
    for (std::size_t i = 2; i < polygon.size(); ++i)  // seen from the grains, corners go round anticlockwise
        mesh.triangles.push_back({0, static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i)});
    return mesh;
}

}  // namespace grainreel
