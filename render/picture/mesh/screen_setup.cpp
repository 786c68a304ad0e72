// Clips triangles and lines and sets them up in pixels. Hot code: an edge must be the same, to the bit, in
// both triangles that share it.
#include "render/picture/mesh/screen_setup.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainreel {
namespace {

constexpr float kOwnsItsEdge = -1e-37f;  // value of `least` with which points on the edge are inside

// Edges are written with the lower end first, so that both triangles at an edge get the same numbers.
bool lower(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

bool set_edge(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Eigen::Vector3f& third,
              ScreenTriangle::Edge& edge) {
    const Eigen::Vector3f& first = lower(from, to) ? from : to;
    const Eigen::Vector3f& last = lower(from, to) ? to : from;
    edge = {first.x(), first.y(), first.y() - last.y(), last.x() - first.x(), kOwnsItsEdge};
    const double side = static_cast<double>(edge.a) * (static_cast<double>(third.x()) - edge.x) +
                        static_cast<double>(edge.b) * (static_cast<double>(third.y()) - edge.y);
    if (side == 0) return false;
    if (side < 0) edge.a = -edge.a, edge.b = -edge.b, edge.least = 0;
    return true;
}

// The plane through three values. area: twice the triangle's area, with its sign.
ScreenPlane plane_through(const Eigen::Vector3f (&at)[3], const std::array<float, 3>& value, double area) {
    const double x1 = static_cast<double>(at[1].x()) - at[0].x(),
                 y1 = static_cast<double>(at[1].y()) - at[0].y();
    const double x2 = static_cast<double>(at[2].x()) - at[0].x(),
                 y2 = static_cast<double>(at[2].y()) - at[0].y();
    const double d1 = static_cast<double>(value[1]) - value[0], d2 = static_cast<double>(value[2]) - value[0];
    ScreenPlane plane;
    plane.at = value[0];
    plane.x = static_cast<float>((d1 * y2 - d2 * y1) / area);
    plane.y = static_cast<float>((d2 * x1 - d1 * x2) / area);
    plane.low = std::min({value[0], value[1], value[2]});
    plane.high = std::max({value[0], value[1], value[2]});
    return plane;
}

// Where the way from a to b crosses the border. a and b are put into an order that does not depend on the
// triangle.
LitCorner crossing(const DrawnSpace::Half& half, LitCorner a, LitCorner b) {
    const auto before = [](const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
        return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    };
    if (before(b.at, a.at)) std::swap(a, b);
    const float from = half.height(a.at), share = from / (from - half.height(b.at));
    return {a.at + share * (b.at - a.at), a.shade + share * (b.shade - a.shade),
            a.own + share * (b.own - a.own)};
}

}  // namespace

DrawnSpace DrawnSpace::of(const Sight& sight, const Cut& cut, float nearest) {
    DrawnSpace space;
    if (!sight.orthographic) space.half[space.count++] = {{0, 0, 1}, nearest};
    for (int i = 0; i < cut.planes; ++i) {
        const Cut::Plane& p = cut.plane[i];
        space.half[space.count++] = {{p.x, p.y, p.z}, p.d};
    }
    return space;
}

bool clip(const DrawnSpace::Half& half, Piece& piece, std::array<Eigen::Vector3f, 2>* section) {
    Piece left;
    int crossed = 0;
    for (int k = 0; k < piece.count; ++k) {
        const auto i = static_cast<std::size_t>(k), j = static_cast<std::size_t>((k + 1) % piece.count);
        const LitCorner &a = piece.corner[i], &b = piece.corner[j];
        const bool keeps_a = half.height(a.at) >= 0, keeps_b = half.height(b.at) >= 0;
        const auto add = [&](const LitCorner& corner) {
            if (left.count < static_cast<int>(left.corner.size())) left.corner[left.count++] = corner;
        };
        if (keeps_a) add(a);
        if (keeps_a == keeps_b) continue;
        const LitCorner there = crossing(half, a, b);
        add(there);
        if (section && crossed < 2) (*section)[crossed] = there.at;
        ++crossed;
    }
    piece = left;
    return crossed == 2;
}

Eigen::Vector3f on_screen(const Sight& sight, const Eigen::Vector3f& at) {
    if (sight.orthographic)
        return {sight.centre_x + sight.focal * at.x(), sight.centre_y - sight.focal * at.y(), -at.z()};
    const float near = 1 / at.z();
    return {sight.centre_x + sight.focal * at.x() * near, sight.centre_y - sight.focal * at.y() * near, near};
}

bool set_up(const Sight& sight, const PortSize& port, const LitCorner& a, const LitCorner& b,
            const LitCorner& c, ScreenTriangle& t) {
    const Eigen::Vector3f at[3] = {on_screen(sight, a.at), on_screen(sight, b.at), on_screen(sight, c.at)};
    const auto [left, right] = std::minmax({at[0].x(), at[1].x(), at[2].x()});
    const auto [top, bottom] = std::minmax({at[0].y(), at[1].y(), at[2].y()});
    const auto pixel = [](float value, int size) {
        return static_cast<int>(std::clamp(std::floor(value), 0.0f, static_cast<float>(size)));
    };
    t.x0 = pixel(left, port.width), t.x1 = pixel(right + 1, port.width);
    t.y0 = pixel(top, port.height), t.y1 = pixel(bottom + 1, port.height);
    if (!(left < right) || !(top < bottom) || t.x0 >= t.x1 || t.y0 >= t.y1) return false;
    for (int e = 0; e < 3; ++e)
        if (!set_edge(at[e], at[(e + 1) % 3], at[(e + 2) % 3], t.edge[e])) return false;
    const double area =
        (static_cast<double>(at[1].x()) - at[0].x()) * (static_cast<double>(at[2].y()) - at[0].y()) -
        (static_cast<double>(at[2].x()) - at[0].x()) * (static_cast<double>(at[1].y()) - at[0].y());
    if (area == 0) return false;
    t.x = at[0].x(), t.y = at[0].y();
    t.near = plane_through(at, {at[0].z(), at[1].z(), at[2].z()}, area);
    t.shade = plane_through(at, {a.shade, b.shade, c.shade}, area);
    for (int i = 0; t.blended && i < 3; ++i)
        t.own[i] = plane_through(at, {a.own[i], b.own[i], c.own[i]}, area);
    return true;
}

bool set_up(const Sight& sight, const DrawnSpace& space, Eigen::Vector3f from, Eigen::Vector3f to,
            int in_border, ScreenLine& line) {
    for (int i = 0; i < space.count; ++i) {
        if (i == in_border) continue;
        const float a = space.half[i].height(from), b = space.half[i].height(to);
        if (a < 0 && b < 0) return false;
        if (a >= 0 && b >= 0) continue;
        const Eigen::Vector3f there = from + a / (a - b) * (to - from);
        (a < 0 ? from : to) = there;
    }
    line.view_from = from, line.view_to = to;
    line.from = on_screen(sight, from), line.to = on_screen(sight, to);
    return true;
}

}  // namespace grainreel
