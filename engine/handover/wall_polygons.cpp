// Makes triangles of the shapes that walls have: polygons cut to a box, tubes, plates with a round hole.
#include "engine/base/mathematics.hpp"
#include "engine/handover/triangle_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace grainreel {

namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;
constexpr double kSmooth = 30;   // degrees; where triangles meet at a larger angle there is an edge
constexpr double kFlat = 1e-5;   // degrees; smooth_bend() of a flat surface
constexpr double kFattest = 8;   // height of a tube's facets divided by their width
constexpr double kTiny = 1e-12;  // m2; a triangle is left out if twice its area is less

double angle_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - corner, v = b - corner;
    return math::atan2(u.cross(v).norm(), u.dot(v));
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min({angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)});
}

double smallest_angle_of_fan(const Polygon& polygon, std::size_t from) {
    const std::size_t n = polygon.size();
    double smallest = kPi;
    for (std::size_t k = 1; k + 1 < n; ++k)
        smallest = std::min(
            smallest, smallest_angle(polygon[from], polygon[(from + k) % n], polygon[(from + k + 1) % n]));
    return smallest;
}

void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, TriangleMesh& mesh) {
    if ((b - a).cross(c - a).norm() < kTiny) return;
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_quad(const std::array<Vec3, 4>& q, TriangleMesh& mesh) {
    add_triangle(q[0], q[1], q[2], mesh);
    add_triangle(q[0], q[2], q[3], mesh);
}

// The point where a ray from the middle meets the rectangle.
Vec3 on_rectangle(const Vec3& middle, double angle, const Vec3& low, const Vec3& high) {
    const double x = math::cos(angle), y = math::sin(angle);
    double far = INFINITY;
    if (x > 1e-12) far = std::min(far, (high.x() - middle.x()) / x);
    if (x < -1e-12) far = std::min(far, (low.x() - middle.x()) / x);
    if (y > 1e-12) far = std::min(far, (high.y() - middle.y()) / y);
    if (y < -1e-12) far = std::min(far, (low.y() - middle.y()) / y);
    return middle + far * Vec3(x, y, 0);
}

Vec3 normal_of(const TriangleMesh& mesh, const TriangleMesh::Triangle& t) {
    const auto at = [&](std::size_t k) { return mesh.vertices[t[k]]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

}  // namespace

Polygon square_on(const Vec3& point, const Vec3& normal, const Vec3& near, double half) {
    const Vec3 middle = near - normal.dot(near - point) * normal;
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    return {middle - half * u - half * v, middle + half * u - half * v, middle + half * u + half * v,
            middle - half * u + half * v};
}

Polygon cut(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double at_a = normal.dot(a - point), at_b = normal.dot(b - point);
        if (at_a >= 0) kept.push_back(a);
        if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0))
            kept.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
    return kept;
}

Polygon cut_to_box(Polygon polygon, const Vec3& low, const Vec3& high) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        polygon = cut(polygon, low, axis);
        polygon = cut(polygon, high, -axis);
    }
    return polygon;
}

void add_polygon(const Polygon& polygon, TriangleMesh& mesh) {
    Polygon corners;
    for (const Vec3& corner : polygon)
        if (corners.empty() ||
            ((corner - corners.back()).norm() > 1e-9 && (corner - corners.front()).norm() > 1e-9))
            corners.push_back(corner);
    if (corners.size() < 3) return;
    std::size_t best = 0;
    for (std::size_t k = 1; k < corners.size(); ++k)
        if (smallest_angle_of_fan(corners, k) > smallest_angle_of_fan(corners, best) + 1e-9) best = k;
    const std::size_t n = corners.size();
    for (std::size_t k = 1; k + 1 < n; ++k)
        add_triangle(corners[best], corners[(best + k) % n], corners[(best + k + 1) % n], mesh);
}

void add_tube(const Vec3& axis, double radius, double low, double high, int facets, TriangleMesh& mesh) {
    const double half = kPi / facets, corner = radius * half / math::sin(half);
    const double width = 2 * radius * half;
    const int rows = std::max(1, static_cast<int>(std::ceil((high - low) / (kFattest * width))));
    const auto at = [&](int facet, int row) {
        const double angle = 2 * half * (facet % facets);
        const double z = row == rows ? high : low + (high - low) * row / rows;
        return Vec3(axis.x() + corner * math::cos(angle), axis.y() + corner * math::sin(angle), z);
    };
    for (int row = 0; row < rows; ++row)
        for (int f = 0; f < facets; ++f)
            add_quad({at(f, row), at(f, row + 1), at(f + 1, row + 1), at(f + 1, row)}, mesh);
}

void add_plate_with_hole(const Vec3& middle, double hole, const Vec3& low, const Vec3& high, int facets,
                         TriangleMesh& mesh) {
    const double half = kPi / facets, corner = hole * half / math::sin(half);
    std::vector<double> corners;
    for (const double x : {low.x(), high.x()})
        for (const double y : {low.y(), high.y()}) {
            const double angle = math::atan2(y - middle.y(), x - middle.x());
            corners.push_back(angle < 0 ? angle + 2 * kPi : angle);
        }
    std::vector<double> angles = corners;
    for (int f = 0; f < facets; ++f) {
        const double angle = 2 * half * f;
        const auto near = [&](double one) { return std::abs(std::remainder(one - angle, 2 * kPi)) < half; };
        if (std::none_of(corners.begin(), corners.end(), near)) angles.push_back(angle);
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t k = 0; k < angles.size(); ++k) {
        const double a = angles[k], b = angles[(k + 1) % angles.size()];
        const auto inner = [&](double angle) {
            return Vec3(middle + corner * Vec3(math::cos(angle), math::sin(angle), 0));
        };
        add_quad({inner(a), on_rectangle(middle, a, low, high), on_rectangle(middle, b, low, high), inner(b)},
                 mesh);
    }
}

double smooth_bend(const TriangleMesh& mesh) {
    using Edge = std::array<double, 6>;
    std::map<Edge, std::vector<Vec3>> edges;  // by their places, because STL does not share corners
    for (const TriangleMesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 a = mesh.vertices[t[k]];
            Vec3 b = mesh.vertices[t[(k + 1) % 3]];
            if (std::lexicographical_compare(b.data(), b.data() + 3, a.data(), a.data() + 3)) std::swap(a, b);
            edges[{a.x(), a.y(), a.z(), b.x(), b.y(), b.z()}].push_back(normal_of(mesh, t));
        }
    double most = kFlat;
    for (const auto& [edge, normals] : edges) {
        if (normals.size() != 2) continue;
        const double bend =
            math::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1])) / kDegree;
        if (bend <= kSmooth) most = std::max(most, 1.01 * bend + 1e-3);
    }
    return most;
}

}  // namespace grainreel
