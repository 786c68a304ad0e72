#include "render/page/bed/grain_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/mesh/room.hpp"

namespace grainreel {
namespace {

using Patch = std::vector<std::int32_t>;  // triangles

constexpr double kSharp = 30 * std::numbers::pi / 180;
constexpr std::size_t most_asked = 30000;  // triangles whose room is asked for
constexpr std::size_t most_of_patch = 15;  // of a patch that is of one mind
constexpr double agreed = 0.8;             // of those
constexpr double least_cosine = 0.3;       // else a patch faces neither side

std::vector<Patch> patches_of(const Surface& surface) {
    std::vector<Patch> patches;
    std::vector<bool> seen(static_cast<std::size_t>(surface.size()), false);
    const double same = std::cos(kSharp);
    for (std::int32_t first = 0; first < surface.size(); ++first) {
        if (seen[static_cast<std::size_t>(first)]) continue;
        seen[static_cast<std::size_t>(first)] = true;
        Patch patch{first};
        for (std::size_t at = 0; at < patch.size(); ++at)
            for (int edge = 0; edge < 3; ++edge) {
                const Neighbour& next = surface.neighbour(patch[at], edge);
                if (next.triangle < 0 || next.flips || seen[static_cast<std::size_t>(next.triangle)])
                    continue;
                if (surface.normal(patch[at]).dot(surface.normal(next.triangle)) < same) continue;
                seen[static_cast<std::size_t>(next.triangle)] = true;
                patch.push_back(next.triangle);
            }
        patches.push_back(std::move(patch));
    }
    return patches;
}

Vec3 middle_of(const Surface& surface, std::int32_t triangle) {
    return (surface.corner(triangle, 0) + surface.corner(triangle, 1) + surface.corner(triangle, 2)) / 3;
}

// Sides by the room that the mesh encloses.
class RoomSides {
  public:
    RoomSides(const Surface& surface, const EnclosedRoom& room)
        : surface_(surface), room_(room), off_(1e-4 * (surface.facts().high - surface.facts().low).norm()) {}

    GrainSide of(std::int32_t triangle) const {
        const Vec3 middle = middle_of(surface_, triangle), normal = off_ * surface_.normal(triangle);
        const bool front = room_.holds(middle + normal), back = room_.holds(middle - normal);
        if (front == back)  // a rib in the room; or the outer face of a thick wall, whose back the wall is
            return front || !surface_.facts().closed() ? GrainSide::both : GrainSide::back;
        return front ? GrainSide::front : GrainSide::back;
    }

  private:
    const Surface& surface_;
    const EnclosedRoom& room_;
    const double off_;  // m
};

void set_by_room(const Surface& surface, const EnclosedRoom& room, const std::vector<Patch>& patches,
                 std::vector<GrainSide>& sides) {
    const RoomSides by_room(surface, room);
    std::size_t left = most_asked;
    for (const Patch& patch : patches) {
        std::array<std::size_t, 3> votes{};
        const std::size_t asked = std::min({patch.size(), most_of_patch, left});
        for (std::size_t k = 0; k < asked; ++k)
            ++votes[static_cast<std::size_t>(by_room.of(patch[k * patch.size() / asked]))];
        left -= asked;
        const auto most = std::max_element(votes.begin(), votes.end());
        const auto side = asked > 0 ? static_cast<GrainSide>(most - votes.begin()) : GrainSide::both;
        const bool one_mind = static_cast<double>(*most) >= agreed * static_cast<double>(asked);
        const bool each = !one_mind && patch.size() <= left;
        for (const std::int32_t triangle : patch)
            sides[static_cast<std::size_t>(triangle)] = each ? by_room.of(triangle) : side;
        if (each) left -= patch.size();
    }
}

// Sides by where something lies: the grains' middle, or the axis of the turn.
void set_by_place(const Surface& surface, const Vec3& middle, const std::optional<BodyTurn>& turn,
                  const std::vector<Patch>& patches, std::vector<GrainSide>& sides) {
    for (const Patch& patch : patches) {
        double towards = 0, area = 0;
        for (const std::int32_t triangle : patch) {
            const Vec3 here = middle_of(surface, triangle);
            Vec3 way = middle - here;
            if (turn) {
                way = turn->through - here;
                way -= way.dot(turn->axis) * turn->axis;
            }
            const double weight = surface.area(triangle), length = way.norm();
            area += weight;
            if (length > 0) towards += weight * surface.normal(triangle).dot(way) / length;
        }
        if (std::abs(towards) < least_cosine * area) continue;
        for (const std::int32_t triangle : patch)
            sides[static_cast<std::size_t>(triangle)] = towards > 0 ? GrainSide::front : GrainSide::back;
    }
}

}  // namespace

std::vector<GrainSide> grain_sides(const std::shared_ptr<const Surface>& surface,
                                   const std::vector<Vec3>& grains, const std::optional<BodyTurn>& turn,
                                   bool tumbles) {
    std::vector<GrainSide> sides(static_cast<std::size_t>(surface->size()), GrainSide::both);
    if (grains.empty()) return sides;
    const EnclosedRoom room(surface);
    const auto inside = room.encloses_anything() ? std::count_if(grains.begin(), grains.end(),
                                                                 [&](const Vec3& g) { return room.holds(g); })
                                                 : 0;
    if (2 * inside > static_cast<std::ptrdiff_t>(grains.size())) {
        set_by_room(*surface, room, patches_of(*surface), sides);
    } else if (!surface->facts().closed() && !tumbles) {
        Vec3 middle(0, 0, 0);
        for (const Vec3& grain : grains) middle += grain / static_cast<double>(grains.size());
        set_by_place(*surface, middle, turn, patches_of(*surface), sides);
    }
    return sides;
}

}  // namespace grainreel
