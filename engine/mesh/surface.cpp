#include "engine/mesh/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/mesh_edges.hpp"

namespace grainreel {

namespace {

constexpr double flat_angle = 1e-6;  // rad

// The normal of a triangle. The cross product of the two shorter edges keeps most digits if the triangle is
// slender.
Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lca = ca.squaredNorm();
    Vec3 normal;
    if (lab >= lbc && lab >= lca)
        normal = bc.cross(ca);
    else if (lbc >= lca)
        normal = ca.cross(ab);
    else
        normal = ab.cross(bc);
    return normal.normalized();
}

}  // namespace

Surface::Surface(TriangleMesh mesh, MeshFacts facts, std::string hash)
    : mesh_(std::move(mesh)), facts_(std::move(facts)), hash_(std::move(hash)) {
    find_normals();
    find_neighbours();
    build_tree();
}

void Surface::find_normals() {
    normals_.resize(mesh_.triangles.size());
    for (std::int32_t t = 0; t < size(); ++t)
        normals_[t] = normal_of(corner(t, 0), corner(t, 1), corner(t, 2));
}

void Surface::find_neighbours() {
    neighbours_.resize(mesh_.triangles.size());
    const double smooth_cosine = math::cos(kSmoothAngle);
    const auto turn = [&](std::int32_t side, std::int32_t other, bool flips) {
        const std::int32_t here = side / 3, there = other / 3;
        const Vec3& n = normal(here);
        const Vec3 m = flips ? Vec3(-normal(there)) : normal(there);
        const double cosine = n.dot(m);
        if (cosine > 0 && n.cross(m).squaredNorm() < flat_angle * flat_angle) return Neighbour::Turn::flat;
        if (cosine > smooth_cosine) return Neighbour::Turn::smooth;
        const Vec3 beyond = corner(there, (other + 2) % 3) - corner(there, other % 3);
        return n.dot(beyond) > flat_angle * beyond.norm() ? Neighbour::Turn::concave
                                                          : Neighbour::Turn::convex;
    };
    EdgeTable(mesh_).each([&](std::int32_t, std::span<const EdgeSide> sides) {
        if (sides.size() != 2) return;
        const std::int32_t a = sides[0].side, b = sides[1].side;
        const bool flips = begin_of(mesh_, a) == begin_of(mesh_, b);
        neighbours_[a / 3][a % 3] = {b / 3, turn(a, b, flips), flips};
        neighbours_[b / 3][b % 3] = {a / 3, turn(b, a, flips), flips};
    });
}

double Surface::area(std::int32_t triangle) const {
    const Vec3& a = corner(triangle, 0);
    return 0.5 * (corner(triangle, 1) - a).cross(corner(triangle, 2) - a).norm();
}

double Surface::farthest_from_axis(const Vec3& through, const Vec3& axis) const {
    const Vec3 unit = axis.normalized();
    double farthest = 0;
    for (const Vec3& vertex : mesh_.vertices) {
        const Vec3 there = vertex - through;
        farthest = std::max(farthest, (there - unit * unit.dot(there)).squaredNorm());
    }
    return std::sqrt(farthest);
}

double Surface::farthest_from(const Vec3& point) const {
    double farthest = 0;
    for (const Vec3& vertex : mesh_.vertices) farthest = std::max(farthest, (vertex - point).squaredNorm());
    return std::sqrt(farthest);
}

// The tree of boxes of a surface, and the search for triangles near a point.

namespace {

constexpr std::int32_t leaf_size = 4;

struct Item {
    Vec3 middle;
    std::int32_t triangle;
};

int longest_axis(const std::vector<Item>& items, std::int32_t first, std::int32_t end) {
    Eigen::AlignedBox3d box;
    for (std::int32_t i = first; i < end; ++i) box.extend(items[i].middle);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
}

// Squared distance (m2) of a point from a box; 0 inside.
double squared_to(const Eigen::AlignedBox3d& box, const Vec3& point) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double out = std::max(0.0, std::max(box.min()[k] - point[k], point[k] - box.max()[k]));
        sum += out * out;
    }
    return sum;
}

}  // namespace

// Builds the tree by halving along the longest axis, at the middle triangle. Boxes are computed from the
// leaves upwards.
void Surface::build_tree() {
    const std::int32_t count = size();
    if (count == 0) return;
    std::vector<Item> items(mesh_.triangles.size());
    for (std::int32_t t = 0; t < count; ++t) items[t] = {(corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3, t};
    nodes_.reserve(mesh_.triangles.size());
    nodes_.push_back({{}, 0, count});
    for (std::size_t n = 0; n < nodes_.size();
         ++n) {  // nodes_ grows meanwhile; parents come before their children
        const std::int32_t first = nodes_[n].first, size = nodes_[n].count;
        if (size <= leaf_size) continue;
        const int axis = longest_axis(items, first, first + size);
        const std::int32_t half = size / 2;
        const auto begin = items.begin() + first;
        std::nth_element(begin, begin + half, begin + size, [axis](const Item& a, const Item& b) {
            return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis]
                                                    : a.triangle < b.triangle;
        });
        nodes_[n] = {{}, static_cast<std::int32_t>(nodes_.size()), 0};
        nodes_.push_back({{}, first, half});
        nodes_.push_back({{}, first + half, size - half});
    }
    order_.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) order_[i] = items[i].triangle;
    for (std::size_t n = nodes_.size(); n-- > 0;) {
        Node& node = nodes_[n];
        if (node.count == 0) {
            node.box = nodes_[node.first].box;
            node.box.extend(nodes_[static_cast<std::size_t>(node.first) + 1].box);
        }
        for (std::int32_t i = node.first; i < node.first + node.count; ++i)
            for (int k = 0; k < 3; ++k) node.box.extend(corner(order_[i], k));
    }
}

// Calls within(triangle, its nearest point) for all triangles within the reach. within() returns the new
// square of the reach (m2); a number below zero ends the search.
template <class Within>
void Surface::visit(const Vec3& point, double squared_reach, Within&& within) const {
    if (nodes_.empty() || !(squared_to(nodes_[0].box, point) <= squared_reach)) return;
    struct Waiting {
        std::int32_t node;
        double squared;
    };
    std::array<Waiting, kDeepest> stack;
    std::size_t size = 0;
    stack[size++] = {0, 0};
    while (size > 0) {
        const Waiting next = stack[--size];
        if (next.squared > squared_reach) continue;
        const Node& node = nodes_[next.node];
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const std::int32_t triangle = order_[i];
            const NearestPoint nearest_point = nearest(triangle, point);
            if (nearest_point.squared <= squared_reach) squared_reach = within(triangle, nearest_point);
            if (squared_reach < 0) return;
        }
        if (node.count > 0) continue;
        Waiting near{node.first, squared_to(nodes_[node.first].box, point)};
        Waiting far{node.first + 1, squared_to(nodes_[static_cast<std::size_t>(node.first) + 1].box, point)};
        if (far.squared < near.squared) std::swap(near, far);
        if (far.squared <= squared_reach) stack[size++] = far;
        if (near.squared <= squared_reach) stack[size++] = near;
    }
}

std::optional<Surface::Nearest> Surface::nearest(const Vec3& point, double reach) const {
    std::optional<Nearest> best;
    if (!(reach >= 0)) return best;
    visit(point, reach * reach, [&](std::int32_t triangle, const NearestPoint& found) {
        const bool better = !best || found.squared < best->point.squared ||
                            (found.squared == best->point.squared && triangle < best->triangle);
        if (better) best = Nearest{triangle, found};
        return best->point.squared;
    });
    return best;
}

void Surface::near(const Vec3& point, double reach, std::vector<std::int32_t>& found) const {
    if (!(reach >= 0)) return;
    const auto before = static_cast<std::ptrdiff_t>(found.size());
    const double squared = reach * reach;
    visit(point, squared, [&](std::int32_t triangle, const NearestPoint&) {
        found.push_back(triangle);
        return squared;
    });
    std::sort(found.begin() + before, found.end());
}

bool Surface::any_within(const Vec3& point, double reach) const {
    bool any = false;
    if (!(reach >= 0)) return any;
    visit(point, reach * reach, [&](std::int32_t, const NearestPoint&) {
        any = true;
        return -1.0;
    });
    return any;
}

void Surface::across_level(double z, std::vector<std::int32_t>& found) const {
    if (nodes_.empty()) return;
    std::array<std::int32_t, kDeepest> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (!(node.box.min().z() < z && z <= node.box.max().z())) continue;
        if (node.count == 0) {
            stack[size++] = node.first;
            stack[size++] = node.first + 1;
        }
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const std::int32_t t = order_[i];
            const int above = (corner(t, 0).z() >= z) + (corner(t, 1).z() >= z) + (corner(t, 2).z() >= z);
            if (above != 0 && above != 3) found.push_back(t);
        }
    }
}

}  // namespace grainreel
