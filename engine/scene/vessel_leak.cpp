#include "engine/scene/vessel_leak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grainreel {

namespace {

// Whether the straight way from one place to another meets no triangle.
bool is_free(const Surface& surface, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double length = way.norm();
    return !surface.meets(from, way / length, length);
}

// That way for a grain and not for a point alone: on its axis and at four sides of it.
bool is_free(const Surface& surface, const Vec3& from, const Vec3& to, double radius) {
    if (!is_free(surface, from, to)) return false;
    const Vec3 along = (to - from).normalized();
    const Vec3 side = radius * along.unitOrthogonal(), other = along.cross(side);
    for (const Vec3& off : {side, Vec3(-side), other, Vec3(-other)})
        if (!is_free(surface, from + off, to + off)) return false;
    return true;
}

// Places in steps over the box around a vessel and a step beyond it.
class Flood {
  public:
    Flood(const Surface& surface, const EnclosedRoom& room, double radius)
        : surface_(surface), room_(room), radius_(radius) {
        const MeshFacts& facts = surface.facts();
        low_ = facts.low, high_ = facts.high;
        if (room.open_above()) high_.z() = room.top();
        step_ = (high_ - low_) / kSteps;
        // A level vessel has no depth of its own along some axis.
        const double least = 1e-6 * step_.maxCoeff();
        step_ = step_.cwiseMax(least);
        from_.assign(static_cast<std::size_t>(kWide) * kWide * kWide, kUnseen);
    }

    std::optional<Vec3> leak() {
        std::vector<int> ways = seeds();
        for (std::size_t next = 0; next < ways.size(); ++next) {
            const Node here = node_of(ways[next]);
            if (is_beyond(here)) return place_left(ways[next]);
            for (const Node& beside : neighbours_of(here)) {
                const int number = number_of(beside);
                if (!is_there(beside) || from_[static_cast<std::size_t>(number)] != kUnseen) continue;
                const Vec3 a = place_of(here), b = place_of(beside);
                if (radius_ > 0 ? !is_free(surface_, a, b, radius_) : !is_free(surface_, a, b)) continue;
                from_[static_cast<std::size_t>(number)] = ways[next];
                ways.push_back(number);
            }
        }
        return std::nullopt;
    }

  private:
    static constexpr int kSteps = 32, kWide = kSteps + 2;  // one more on each side
    static constexpr int kUnseen = -2, kSeed = -1;
    using Node = std::array<int, 3>;

    static int number_of(const Node& n) { return (n[2] * kWide + n[1]) * kWide + n[0]; }
    static Node node_of(int number) {
        return {number % kWide, number / kWide % kWide, number / kWide / kWide};
    }
    // Off the middle of a step, so that no way lies in a plane of the vessel.
    Vec3 place_of(const Node& n) const {
        constexpr double off[3] = {0.4873, 0.5171, 0.5067};
        Vec3 place;
        for (int k = 0; k < 3; ++k)
            place[k] = low_[k] + (n[static_cast<std::size_t>(k)] - 1 + off[k]) * step_[k];
        return place;
    }
    static std::array<Node, 6> neighbours_of(const Node& n) {
        const auto [x, y, z] = n;
        return {Node{x, y, z - 1}, Node{x - 1, y, z}, Node{x + 1, y, z},
                Node{x, y - 1, z}, Node{x, y + 1, z}, Node{x, y, z + 1}};
    }
    bool is_there(const Node& n) const {
        if (*std::min_element(n.begin(), n.end()) < 0 || *std::max_element(n.begin(), n.end()) >= kWide)
            return false;
        return !room_.open_above() || n[2] <= kSteps;
    }
    static bool is_beyond(const Node& n) {
        return *std::min_element(n.begin(), n.end()) == 0 ||
               *std::max_element(n.begin(), n.end()) == kWide - 1;
    }

    // Some that lie in the room.
    std::vector<int> seeds() {
        constexpr int apart = 37;  // shares no factor with kSteps
        constexpr std::size_t enough = 8;
        std::vector<int> found;
        for (int k = 0; k < kSteps * kSteps * kSteps && found.size() < enough; k += apart) {
            const Node node{1 + k % kSteps, 1 + k / kSteps % kSteps, 1 + k / kSteps / kSteps};
            if (!room_.holds(place_of(node), std::max(radius_, 1e-9 * step_.maxCoeff()))) continue;
            from_[static_cast<std::size_t>(number_of(node))] = kSeed;
            found.push_back(number_of(node));
        }
        return found;
    }

    // The first place out of the room on the way to there.
    Vec3 place_left(int number) const {
        int outside = number;
        for (int at = number; at != kSeed; at = from_[static_cast<std::size_t>(at)]) {
            if (room_.holds(place_of(node_of(at)))) break;
            outside = at;
        }
        return place_of(node_of(outside));
    }

    const Surface& surface_;
    const EnclosedRoom& room_;
    const double radius_;
    Vec3 low_, high_, step_;
    std::vector<int> from_;  // by number: the node before, on the way from a seed
};

bool opens(const Surface& surface, const EnclosedRoom& room, const Vec3& beyond, const Vec3& normal,
           double diameter) {
    const Vec3 one = beyond + 0.25 * diameter * normal, other = beyond - 0.25 * diameter * normal;
    if (!is_free(surface, one, other)) return false;
    if (room.open_above() && std::max(one.z(), other.z()) > room.top()) return false;
    return room.holds(one) != room.holds(other);
}

std::optional<Vec3> hole_at_edges(const Surface& surface, const EnclosedRoom& room, double diameter) {
    constexpr int most = 20'000;  // edges
    constexpr double nearly = 0.98;
    int looked = 0;
    for (std::int32_t t = 0; t < surface.size(); ++t) {
        for (int e = 0; e < 3; ++e) {
            if (surface.neighbour(t, e).triangle >= 0) continue;
            if (++looked > most) return std::nullopt;
            const Vec3 &a = surface.corner(t, e), &b = surface.corner(t, (e + 1) % 3);
            // Corners run counter-clockwise about the normal, so this points away from the third.
            const Vec3 out = (b - a).normalized().cross(surface.normal(t));
            const Vec3 beyond = 0.5 * (a + b) + nearly * diameter * out;
            if (opens(surface, room, beyond, surface.normal(t), diameter)) return beyond;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<Vec3> leak_of(const Surface& surface, const EnclosedRoom& room, double diameter) {
    const double radius = 0.5 * diameter;
    // Most vessels hold points already.
    if (Flood(surface, room, 0).leak())
        if (const auto leak = Flood(surface, room, 0.7 * radius).leak()) return leak;
    if (surface.facts().open_edges == 0) return std::nullopt;
    return hole_at_edges(surface, room, diameter);
}

}  // namespace grainreel
