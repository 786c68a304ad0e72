// Searches on a surface: the nearest point of one triangle, and the triangles that a ray meets.

#include <algorithm>
#include <array>
#include <cmath>

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

// The nearest point on edge e. It is computed from the vertex with the lower number, so that both triangles
// find the same point.
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

// If the foot of the perpendicular is outside of the triangle, the nearest point lies on an edge that the
// foot is outside of. C. Ericson, Real-Time Collision Detection (2005), 5.1.5, forms quotients of areas. This
// code does not, because they mean nothing on slender triangles. There the sides of the edges decide, and the
// result is right to within the triangle's height.
NearestPoint Surface::nearest(std::int32_t triangle, const Vec3& point) const {
    const TriangleMesh::Triangle& numbers = mesh_.triangles[triangle];
    Corners corners{numbers, {}};
    for (std::size_t k = 0; k < 3; ++k) corners.at[k] = &mesh_.vertices[numbers[k]];
    const Vec3& n = normal(triangle);
    const Vec3 to[3] = {point - *corners.at[0], point - *corners.at[1], point - *corners.at[2]};
    NearestPoint best{point, -1, Feature::face};
    for (std::size_t e = 0; e < 3; ++e) {
        // This is n . (edge x way to the point); the edge is the difference of the ways from its two corners.
        if (!(n.dot(to[e].cross(to[after(e)])) < 0)) continue;
        const NearestPoint here = nearest_on_edge(corners, e, point);
        if (best.squared < 0 || here.squared < best.squared) best = here;
    }
    if (best.squared >= 0) return best;
    const double distance = n.dot(to[0]);
    return {point - distance * n, distance * distance, Feature::face};
}

// The edge tests in nearest() give the height of the point above each edge, times the length of the edge.
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

// Rays through a surface. The triangles are sheared so that the ray is the axis of z, as in S. Woop, C.
// Benthin and I. Wald, Watertight Ray/Triangle Intersection, J. Computer Graphics Techniques 2, 65 (2013). A
// vertex then has the same place for all its triangles. The side of an edge on which the axis passes is found
// without rounding. If the axis passes through the edge itself, it counts as passing at (d, d^2) for an
// endlessly small d (H. Edelsbrunner and E. Muecke, Simulation of Simplicity, ACM Trans. Graphics 9, 66,
// 1990).

namespace {

struct Sheared {
    double x, y, z;
};

// Returns 1 if the axis is left of the edge from a to b, and -1 if it is right of it. For the edge from b to
// a the result is the opposite.
int side_of(const Sheared& a, const Sheared& b) {
    const double p = a.x * b.y, q = a.y * b.x;
    if (p != q) return p > q ? 1 : -1;
    // The rounding errors of the products. If these are equal too, the axis is on the line.
    const double rest_p = std::fma(a.x, b.y, -p), rest_q = std::fma(a.y, b.x, -q);
    if (rest_p != rest_q) return rest_p > rest_q ? 1 : -1;
    if (a.y != b.y) return a.y > b.y ? 1 : -1;
    if (a.x != b.x) return b.x > a.x ? 1 : -1;
    return 0;
}

class Ray {
  public:
    Ray(const Vec3& from, const Vec3& direction, const Eigen::AlignedBox3d& all)
        : from_(from), direction_(direction) {
        direction.cwiseAbs().maxCoeff(&z_);
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        if (direction[z_] < 0) std::swap(x_, y_);
        slope_x_ = direction[x_] / direction[z_];
        slope_y_ = direction[y_] / direction[z_];
        scale_ = 1 / direction[z_];
        // Roundings of the shear move no vertex farther than this.
        pad_ = 1e-14 * ((from - all.center()).norm() + all.sizes().norm());
    }

    // The distance to the box; negative if the ray misses it.
    double enters(const Eigen::AlignedBox3d& box) const {
        double near = 0, far = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const double low = box.min()[k] - pad_ - from_[k], high = box.max()[k] + pad_ - from_[k];
            if (direction_[k] == 0) {
                if (low > 0 || high < 0) return -1;
                continue;
            }
            const double a = low / direction_[k], b = high / direction_[k];
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        return near <= far ? near : -1;
    }

    // The distance (m) at which the ray crosses the triangle; negative if it does not. `front` says
    // whether the ray comes from the side to which the normal points.
    double meets(const Vec3& a, const Vec3& b, const Vec3& c, bool& front) const {
        const Sheared p = sheared(a), q = sheared(b), r = sheared(c);
        const int side = side_of(p, q);
        if (side == 0 || side_of(q, r) != side || side_of(r, p) != side) return -1;
        front = side < 0;
        const double u = q.x * r.y - q.y * r.x, v = r.x * p.y - r.y * p.x, w = p.x * q.y - p.y * q.x;
        const double low = std::min({p.z, q.z, r.z}), high = std::max({p.z, q.z, r.z}), whole = u + v + w;
        const double z = (u * p.z + v * q.z + w * r.z) / whole;
        return whole != 0 && std::isfinite(z) ? std::clamp(z, low, high) : 0.5 * (low + high);
    }

  private:
    Sheared sheared(const Vec3& vertex) const {
        const Vec3 there = vertex - from_;
        return {there[x_] - slope_x_ * there[z_], there[y_] - slope_y_ * there[z_], scale_ * there[z_]};
    }

    Vec3 from_, direction_;
    int x_ = 0, y_ = 1, z_ = 2;
    double slope_x_, slope_y_, scale_, pad_;
};

}  // namespace

// Calls met(hit) for each crossing within `reach` (m), nearer boxes first. met() returns the new reach of the
// ray.
template <class Met>
void Surface::visit_ray(const Vec3& from, const Vec3& direction, double reach, Met&& met) const {
    if (nodes_.empty()) return;
    const Ray ray(from, direction, nodes_[0].box);
    struct Waiting {
        std::int32_t node;
        double distance;
    };
    std::array<Waiting, kDeepest> stack;
    std::size_t size = 0;
    const double first = ray.enters(nodes_[0].box);
    if (first >= 0) stack[size++] = {0, first};
    while (size > 0) {
        const Waiting next = stack[--size];
        if (next.distance > reach) continue;
        const Node& node = nodes_[next.node];
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const std::int32_t t = order_[i];
            bool front = false;
            const double distance = ray.meets(corner(t, 0), corner(t, 1), corner(t, 2), front);
            if (distance >= 0 && distance <= reach) reach = met(Hit{t, distance, front});
            if (reach < 0) return;
        }
        if (node.count > 0) continue;
        Waiting near{node.first, ray.enters(nodes_[node.first].box)};
        Waiting far{node.first + 1, ray.enters(nodes_[static_cast<std::size_t>(node.first) + 1].box)};
        if (far.distance < near.distance) std::swap(near, far);
        if (far.distance >= 0 && far.distance <= reach) stack[size++] = far;
        if (near.distance >= 0 && near.distance <= reach) stack[size++] = near;
    }
}

std::optional<Surface::Hit> Surface::first_hit(const Vec3& from, const Vec3& direction) const {
    std::optional<Hit> best;
    visit_ray(from, direction, std::numeric_limits<double>::infinity(), [&](const Hit& hit) {
        const bool better = !best || hit.distance < best->distance ||
                            (hit.distance == best->distance && hit.triangle < best->triangle);
        if (better) best = hit;
        return best->distance;
    });
    return best;
}

void Surface::all_hits(const Vec3& from, const Vec3& direction, std::vector<Hit>& hits) const {
    const auto before = static_cast<std::ptrdiff_t>(hits.size());
    visit_ray(from, direction, std::numeric_limits<double>::infinity(), [&](const Hit& hit) {
        hits.push_back(hit);
        return std::numeric_limits<double>::infinity();
    });
    std::sort(hits.begin() + before, hits.end(), [](const Hit& a, const Hit& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
    });
}

bool Surface::meets(const Vec3& from, const Vec3& direction, double reach) const {
    bool any = false;
    visit_ray(from, direction, reach, [&](const Hit&) {
        any = true;
        return -1.0;
    });
    return any;
}

}  // namespace grainreel
