#include "engine/scene/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

bool in_container(const Container& c, const Vec3& place, double margin) {
    if (c.shape == Container::Shape::mesh) {
        const bool below_rim = place.z() <= c.height - (c.lid ? margin : 0);
        return below_rim && (margin > 0 ? c.room->holds(place, margin) : c.room->holds(place));
    }
    if (place.z() < margin || place.z() > c.height - margin) return false;
    if (c.shape == Container::Shape::cylinder)
        return math::hypot(place.x(), place.y()) <= c.half_width - margin;
    const bool slanted = c.shape == Container::Shape::wedge && place.z() < c.slant_height;
    const double slope = slanted ? math::cos(c.half_angle) : 1;
    if (std::abs(place.y()) > c.half_width_at(place.z()) - margin / slope) return false;
    return c.periodic_depth || std::abs(place.x()) <= c.depth / 2 - margin;
}

// The k-th of numbers in [0, 1)^3 that fill a cube evenly (the additive recurrence R3, after M. Roberts
// 2018: powers of 1/g, g^4 = g + 1).
Vec3 evenly(int k) {
    constexpr double g = 1.2207440846057596;
    const auto part = [&](double step) { return std::fmod(0.5 + step * k, 1.0); };
    return {part(1 / g), part(1 / (g * g)), part(1 / (g * g * g))};
}

// Whether a place is inside a closed surface: a level ray leaves it an odd number of times.
bool is_inside(const Surface& surface, const Vec3& place) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(place, Vec3(1, 0, 0), hits);
    return hits.size() % 2 == 1;
}

}  // namespace

bool FreeSpace::in_room(const Vec3& place, double margin) const {
    if (region_ && !region_->holds(place, margin)) return false;
    return container_.shape == Container::Shape::none || in_container(container_, place, margin);
}

bool FreeSpace::before_planes(const Vec3& place, double margin) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const ScenePlane& plane) {
        return plane.normal.dot(place - plane.point) >= margin;
    });
}

bool FreeSpace::off_meshes(const Vec3& place, double margin) const {
    return std::none_of(meshes_.begin(), meshes_.end(), [&](const Shared<Surface>& mesh) {
        if (margin > 0 && mesh->any_within(place, margin)) return true;
        return !region_ && mesh->facts().closed() && is_inside(*mesh, place);
    });
}

bool FreeSpace::holds(const Vec3& place, double margin) const {
    return in_room(place, margin) && before_planes(place, margin) && off_meshes(place, margin);
}

FreeSpace::FreeSpace(const Scene& scene)
    : container_(scene.container), region_(scene.start.region), planes_(scene.walls) {
    for (const SceneMesh& mesh : scene.meshes)
        if (&mesh != scene.vessel()) meshes_.push_back(mesh.surface);
    volume_ = region_ ? region_->volume() : container_.volume();
    set_box(scene);
    if (region_ || !planes_.empty() || !meshes_.empty()) measure();
}

void FreeSpace::set_box(const Scene& scene) {
    if (region_) {
        low_ = region_->low, high_ = region_->high;
    } else if (const SceneMesh* vessel = scene.vessel()) {
        const MeshFacts& facts = vessel->surface->facts();
        low_ = Vec3(facts.low.x(), facts.low.y(), container_.base());
        high_ = Vec3(facts.high.x(), facts.high.y(), container_.height);
    } else {
        const bool round = container_.shape == Container::Shape::cylinder;
        const double half_depth = round ? container_.half_width : container_.depth / 2;
        low_ = Vec3(-half_depth, -container_.half_width, 0);
        high_ = Vec3(half_depth, container_.half_width, container_.height);
    }
}

void FreeSpace::measure() {
    // Places near meshes are costly to test: one in a mesh's room takes sixteen rays, one beside a solid
    // takes one.
    const bool dear = container_.shape == Container::Shape::mesh ||
                      std::any_of(meshes_.begin(), meshes_.end(),
                                  [](const Shared<Surface>& mesh) { return mesh->facts().closed(); });
    const int places = dear ? 10'000 : 100'000;
    measured_ = true;
    int inside = 0;
    for (int k = 0; k < places; ++k) {
        const Vec3 place = low_ + evenly(k).cwiseProduct(high_ - low_);
        const bool there = in_room(place, 0);
        if (!there && !region_) continue;
        ++inside;  // in the container or in the box, whose volume is known
        if (there && before_planes(place, 0) && off_meshes(place, 0)) heights_.push_back(place.z());
    }
    std::sort(heights_.begin(), heights_.end());
    volume_ *= static_cast<double>(heights_.size()) / std::max(inside, 1);
}

double FreeSpace::height_of_share(double part) const {
    if (measured_) {
        if (heights_.empty()) return 0;
        const double at = part * static_cast<double>(heights_.size() - 1);
        return heights_[static_cast<std::size_t>(at)];
    }
    const double wanted = part * volume_;
    double low = container_.base(), high = container_.height;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (container_.volume_below(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double FreeSpace::share_of(double height, double margin,
                           const std::function<bool(const Vec3&)>& condition) const {
    constexpr int kPlaces = 10'000;
    const Vec3 top(high_.x(), high_.y(), std::min(high_.z(), height));
    int all = 0, fulfil = 0;
    for (int k = 0; k < kPlaces; ++k) {
        const Vec3 place = low_ + evenly(k).cwiseProduct(top - low_);
        if (!holds(place, margin)) continue;
        ++all;
        fulfil += condition(place) ? 1 : 0;
    }
    return all > 0 ? static_cast<double>(fulfil) / all : 0;
}

namespace {

// Whether the straight way from one place to another meets no triangle.
bool is_free(const Surface& surface, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double length = way.norm();
    return !surface.meets(from, way / length, length);
}

// The same for a grain of this radius: tested on the axis of its way and on four lines beside it.
bool is_free(const Surface& surface, const Vec3& from, const Vec3& to, double radius) {
    if (!is_free(surface, from, to)) return false;
    const Vec3 along = (to - from).normalized();
    const Vec3 side = radius * along.unitOrthogonal(), other = along.cross(side);
    for (const Vec3& off : {side, Vec3(-side), other, Vec3(-other)})
        if (!is_free(surface, from + off, to + off)) return false;
    return true;
}

// Searches for a leak by going from place to place on a grid, in the box around a vessel and one step beyond
// it.
class Flood {
  public:
    Flood(const Surface& surface, const EnclosedRoom& room, double radius)
        : surface_(surface), room_(room), radius_(radius) {
        const MeshFacts& facts = surface.facts();
        low_ = facts.low, high_ = facts.high;
        if (room.open_above()) high_.z() = room.top();
        step_ = (high_ - low_) / kSteps;
        // A flat vessel has no extent along some axis.
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
                if (!is_there(beside) || from_[number] != kUnseen) continue;
                const Vec3 a = place_of(here), b = place_of(beside);
                if (radius_ > 0 ? !is_free(surface_, a, b, radius_) : !is_free(surface_, a, b)) continue;
                from_[number] = ways[next];
                ways.push_back(number);
            }
        }
        return std::nullopt;
    }

  private:
    static constexpr int kSteps = 32, kWide = kSteps + 2;  // one more place on each side
    static constexpr int kUnseen = -2, kSeed = -1;
    using Node = std::array<int, 3>;

    static int number_of(const Node& n) { return (n[2] * kWide + n[1]) * kWide + n[0]; }
    static Node node_of(int number) {
        return {number % kWide, number / kWide % kWide, number / kWide / kWide};
    }
    // Places are a little off the middle of their cell, so that no way lies in a plane of the vessel.
    Vec3 place_of(const Node& n) const {
        constexpr double off[3] = {0.4873, 0.5171, 0.5067};
        Vec3 place;
        for (int k = 0; k < 3; ++k) place[k] = low_[k] + (n[k] - 1 + off[k]) * step_[k];
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

    // Some places in the room, where the search begins.
    std::vector<int> seeds() {
        constexpr int apart = 37;  // shares no factor with kSteps
        constexpr std::size_t enough = 8;
        std::vector<int> found;
        for (int k = 0; k < kSteps * kSteps * kSteps && found.size() < enough; k += apart) {
            const Node node{1 + k % kSteps, 1 + k / kSteps % kSteps, 1 + k / kSteps / kSteps};
            if (!room_.holds(place_of(node), std::max(radius_, 1e-9 * step_.maxCoeff()))) continue;
            from_[number_of(node)] = kSeed;
            found.push_back(number_of(node));
        }
        return found;
    }

    // The first place outside the room on the way from a seed to this place.
    Vec3 place_left(int number) const {
        int outside = number;
        for (int at = number; at != kSeed; at = from_[at]) {
            if (room_.holds(place_of(node_of(at)))) break;
            outside = at;
        }
        return place_of(node_of(outside));
    }

    const Surface& surface_;
    const EnclosedRoom& room_;
    const double radius_;
    Vec3 low_, high_, step_;
    std::vector<int> from_;  // for each place, the one before it on the way from a seed
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
            // Corners run counter-clockwise about the normal, so `out` points away from the third corner.
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
    // The first search is for a mere point, which is quick; most vessels hold even points.
    if (Flood(surface, room, 0).leak())
        if (const auto leak = Flood(surface, room, 0.7 * radius).leak()) return leak;
    if (surface.facts().open_edges == 0) return std::nullopt;
    return hole_at_edges(surface, room, diameter);
}

}  // namespace grainreel
