#include "engine/mesh/level_section.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "engine/base/mathematics.hpp"

namespace grainreel {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr std::size_t most_borders = 512, most_bins = 1024;
constexpr double same_border = 1e-9;  // as a share of the section's width

// The place at which an edge crosses the level z. Both triangles that share the edge get the same bits.
Vec2 crossing(const Vec3& from, const Vec3& to, double z) {
    const double t = (z - from.z()) / (to.z() - from.z());
    return from.head<2>() + t * (to.head<2>() - from.head<2>());
}

}  // namespace

Vec3 level_direction(int i) {
    // The directions of a quarter turn, exact along the axes.
    static const std::array<Vec3, 4> quarter = [] {
        const double diagonal = std::numbers::sqrt2 / 2, far = math::cos(std::numbers::pi / 8),
                     near = math::sin(std::numbers::pi / 8);
        return std::array<Vec3, 4>{Vec3(1, 0, 0), Vec3(far, near, 0), Vec3(diagonal, diagonal, 0),
                                   Vec3(near, far, 0)};
    }();
    Vec3 direction = quarter[i % 4];
    for (int turns = i / 4; turns > 0; --turns) direction = Vec3(-direction.y(), direction.x(), 0);
    return direction;
}

LevelSection::LevelSection(const Surface& surface, const std::vector<char>& closed, double z) {
    std::vector<std::int32_t> triangles;
    surface.across_level(z, triangles);
    segments_.reserve(triangles.size());
    for (const std::int32_t t : triangles) cut(surface, t, closed[t] != 0, z);
    for (int i = 0; i < kLevelAxes; ++i) sort_across(axes_[i], i);
}

// One side of the triangle runs up through the level, and another runs down. Seen from above, the normal lies
// to the right of the way from the second crossing to the first.
void LevelSection::cut(const Surface& surface, std::int32_t triangle, bool closed, double z) {
    const TriangleMesh::Triangle& numbers = surface.mesh().triangles[triangle];
    Segment segment{{}, {}, closed};
    for (int e = 0; e < 3; ++e) {
        const int f = (e + 1) % 3;
        const Vec3 &begin = surface.corner(triangle, e), &end = surface.corner(triangle, f);
        const bool from_above = begin.z() >= z, to_above = end.z() >= z;
        if (from_above == to_above) continue;
        const bool back = numbers[e] > numbers[f];
        (to_above ? segment.b : segment.a) = back ? crossing(end, begin, z) : crossing(begin, end, z);
    }
    segments_.push_back(segment);
}

void LevelSection::sort_across(Axis& axis, int number) {
    axis.along = level_direction(number).head<2>();
    axis.across = Vec2(-axis.along.y(), axis.along.x());
    if (segments_.empty()) return;
    std::vector<std::pair<double, double>> spans;  // lowest and highest place of each segment across the axis
    spans.reserve(segments_.size());
    double low = axis.across.dot(segments_[0].a), high = low;
    for (const Segment& s : segments_) {
        const double u = axis.across.dot(s.a), v = axis.across.dot(s.b);
        spans.push_back({std::min(u, v), std::max(u, v)});
        low = std::min(low, spans.back().first);
        high = std::max(high, spans.back().second);
    }
    const std::size_t bins = std::clamp<std::size_t>(segments_.size(), 8, most_bins);
    axis.first = low;
    axis.per_width = high > low ? static_cast<double>(bins) / (high - low) : 0;
    const auto bin = [&](double u) {
        return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, (u - low) * axis.per_width)));
    };
    axis.begins.assign(bins + 1, 0);
    std::vector<std::uint32_t> next;
    for (const bool counting : {true, false}) {
        for (std::size_t i = 0; i < spans.size(); ++i)
            for (std::size_t b = bin(spans[i].first); b <= bin(spans[i].second); ++b) {
                if (counting)
                    ++axis.begins[b + 1];
                else
                    axis.segments[next[b]++] = static_cast<std::int32_t>(i);
            }
        if (!counting) break;
        std::partial_sum(axis.begins.begin(), axis.begins.end(), axis.begins.begin());
        next.assign(axis.begins.begin(), axis.begins.end() - 1);
        axis.segments.resize(axis.begins.back());
    }
}

bool LevelSection::encloses(double x, double y) const {
    const Vec2 place(x, y);
    for (const Axis& axis : axes_) {
        if (axis.segments.empty()) return false;
        const double u = axis.across.dot(place), s = axis.along.dot(place);
        const double scaled = (u - axis.first) * axis.per_width;
        const std::size_t bins = axis.begins.size() - 1;
        if (!(scaled >= 0)) return false;
        const std::size_t bin = std::min(bins - 1, static_cast<std::size_t>(scaled));
        bool ahead = false, behind = false;
        for (std::uint32_t i = axis.begins[bin]; i < axis.begins[bin + 1] && !(ahead && behind); ++i) {
            const Segment& segment = segments_[axis.segments[i]];
            const double ua = axis.across.dot(segment.a) - u, ub = axis.across.dot(segment.b) - u;
            if ((ua <= 0) == (ub <= 0)) continue;
            const double sa = axis.along.dot(segment.a), sb = axis.along.dot(segment.b);
            (sa + ua / (ua - ub) * (sb - sa) > s ? ahead : behind) = true;
        }
        if (!ahead || !behind) return false;
    }
    return true;
}

// All x at which the section has a corner. If there are more than most_borders, an even selection of them.
std::vector<double> LevelSection::borders() const {
    std::vector<double> all;
    for (const Segment& s : segments_) {
        all.push_back(s.a.x());
        all.push_back(s.b.x());
    }
    std::sort(all.begin(), all.end());
    const double alike = all.empty() ? 0 : same_border * (all.back() - all.front());
    all.erase(std::unique(all.begin(), all.end(), [&](double x, double y) { return y - x <= alike; }),
              all.end());
    if (all.size() <= most_borders) return all;
    std::vector<double> some(most_borders);
    for (std::size_t i = 0; i < most_borders; ++i) some[i] = all[i * (all.size() - 1) / (most_borders - 1)];
    return some;
}

std::vector<LevelPiece> LevelSection::enclosed_pieces() const {
    std::vector<LevelPiece> pieces;
    std::vector<const Segment*> waiting, active, crossed;
    for (const Segment& segment : segments_) waiting.push_back(&segment);
    const auto first_x = [](const Segment* s) { return std::min(s->a.x(), s->b.x()); };
    std::sort(waiting.begin(), waiting.end(),
              [&](const Segment* s, const Segment* t) { return first_x(s) > first_x(t); });
    const std::vector<double> edges = borders();
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double x = 0.5 * (edges[i] + edges[i + 1]);
        for (; !waiting.empty() && first_x(waiting.back()) <= x; waiting.pop_back())
            active.push_back(waiting.back());
        std::erase_if(active, [x](const Segment* s) { return std::max(s->a.x(), s->b.x()) <= x; });
        crossed.assign(active.begin(), active.end());
        add_pieces(edges[i], edges[i + 1], crossed, pieces);
    }
    return pieces;
}

void LevelSection::add_pieces(double x0, double x1, std::vector<const Segment*>& crossed,
                              std::vector<LevelPiece>& pieces) const {
    const double x = 0.5 * (x0 + x1);
    std::sort(crossed.begin(), crossed.end(),
              [x](const Segment* s, const Segment* t) { return s->at(x) < t->at(x); });
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossed.size(); ++i) {
        const Segment &low = *crossed[i], &high = *crossed[i + 1];
        if (low.closed) winding += low.a.x() < low.b.x() ? 1 : -1;
        const double from = low.at(x), to = high.at(x);
        if (!(to > from) || !encloses(x, 0.5 * (from + to))) continue;
        // If borders were left out, a segment may end within the strip.
        const auto side = [&](const Segment& s, double middle) {
            const double first = std::max(x0, std::min(s.a.x(), s.b.x()));
            const double slope = first < x ? (middle - s.at(first)) / (x - first) : 0;
            return std::array<double, 2>{middle - slope * (x - x0), middle + slope * (x1 - x)};
        };
        pieces.push_back({x0, x1, side(low, from), side(high, to), winding});
    }
}

}  // namespace grainreel
