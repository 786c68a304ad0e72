// The tree of boxes of a surface, and what is near a point.
#include <algorithm>
#include <array>

#include "engine/mesh/surface.hpp"

namespace grainreel {
namespace {

constexpr std::int32_t leaf_size = 4;

struct Item {
    Vec3 middle;
    std::int32_t triangle;
};

int longest_axis(const std::vector<Item>& items, std::int32_t first, std::int32_t end) {
    Eigen::AlignedBox3d box;
    for (std::int32_t i = first; i < end; ++i) box.extend(items[static_cast<std::size_t>(i)].middle);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
}

// m2, of a point from a box; 0 in it.
double squared_to(const Eigen::AlignedBox3d& box, const Vec3& point) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double out = std::max(0.0, std::max(box.min()[k] - point[k], point[k] - box.max()[k]));
        sum += out * out;
    }
    return sum;
}

}  // namespace

// Halves along the longest axis, at the middle triangle; boxes from the leaves upwards.
void Surface::build_tree() {
    const std::int32_t count = size();
    if (count == 0) return;
    std::vector<Item> items(mesh_.triangles.size());
    for (std::int32_t t = 0; t < count; ++t)
        items[static_cast<std::size_t>(t)] = {(corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3, t};
    nodes_.reserve(mesh_.triangles.size());
    nodes_.push_back({{}, 0, count});
    for (std::size_t n = 0; n < nodes_.size(); ++n) {  // grows: parents stand before their children
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
            node.box = nodes_[static_cast<std::size_t>(node.first)].box;
            node.box.extend(nodes_[static_cast<std::size_t>(node.first) + 1].box);
        }
        for (std::int32_t i = node.first; i < node.first + node.count; ++i)
            for (int k = 0; k < 3; ++k) node.box.extend(corner(order_[static_cast<std::size_t>(i)], k));
    }
}

// Calls within(triangle, its nearest point) for all triangles not farther than the reach, which it may
// shorten by what it returns: the new square of the reach (m2); below zero it ends.
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
        const Node& node = nodes_[static_cast<std::size_t>(next.node)];
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const std::int32_t triangle = order_[static_cast<std::size_t>(i)];
            const NearestPoint nearest_point = nearest(triangle, point);
            if (nearest_point.squared <= squared_reach) squared_reach = within(triangle, nearest_point);
            if (squared_reach < 0) return;
        }
        if (node.count > 0) continue;
        Waiting near{node.first, squared_to(nodes_[static_cast<std::size_t>(node.first)].box, point)};
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
        const Node& node = nodes_[static_cast<std::size_t>(stack[--size])];
        if (!(node.box.min().z() < z && z <= node.box.max().z())) continue;
        if (node.count == 0) {
            stack[size++] = node.first;
            stack[size++] = node.first + 1;
        }
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const std::int32_t t = order_[static_cast<std::size_t>(i)];
            const int above = (corner(t, 0).z() >= z) + (corner(t, 1).z() >= z) + (corner(t, 2).z() >= z);
            if (above != 0 && above != 3) found.push_back(t);
        }
    }
}

}  // namespace grainreel
