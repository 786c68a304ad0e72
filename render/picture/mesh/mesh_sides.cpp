// Finds which sides of a mesh look into something that it encloses (find_sides() of mesh_shape.hpp), by rays
// from places on its surface.
#include "render/picture/mesh/mesh_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/base/lists.hpp"
#include "engine/mesh/room.hpp"

namespace grainreel {
namespace {

constexpr int kRays = 12;              // rays to each side of a place
constexpr std::size_t kPlaces = 4000;  // places that rays start from, at most
constexpr std::size_t kPlacesOfPatch = 8;

// A side looks into an enclosed space (a room) when at least this share of its rays meets the surface. The
// second share is for meshes that are not said to be vessels.
constexpr double kEnclosed = 0.5, kSurelyEnclosed = 0.6;
// How much more of the surface one side of an open sheet must see than the other side.
constexpr double kDiffers = 0.3, kDiffersInVessel = 0.05;
// A closed part is the sheet around a vessel's room, or a body in that room, when at least this share of it
// borders on the room.
constexpr double kHoldsRoom = 0.5, kInRoom = 0.9;
constexpr double kShellShare = 0.15;  // least share of the area of thick walls that looks into the room

// Directions around z, weighted by the cosine, as a matt surface takes its light.
std::array<Vec3, kRays> make_directions() {
    std::array<Vec3, kRays> directions;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kRays; ++i) {
        const double square = (i + 0.5) / kRays, out = std::sqrt(square);
        directions[i] = {out * std::cos(golden * i), out * std::sin(golden * i), std::sqrt(1 - square)};
    }
    return directions;
}

// Sums over the rays from one patch, or from one connected part.
struct Seen {
    double area = 0;                       // m2, of all triangles
    double weight = 0;                     // sum of the weights of the places
    double front = 0, back = 0;            // sums of weight times the share of rays that meet the surface
    double room_front = 0, room_back = 0;  // weights of the places that the vessel's room lies beside
    double front_share() const { return weight > 0 ? front / weight : 0; }
    double back_share() const { return weight > 0 ? back / weight : 0; }
    void add(const Seen& other) {
        area += other.area, weight += other.weight;
        front += other.front, back += other.back;
        room_front += other.room_front, room_back += other.room_back;
    }
};

class SideFinder {
  public:
    SideFinder(const Surface& surface, double edge_angle, MeshLook look)
        : surface_(surface),
          look_(look),
          small_(1e-6 * (surface.facts().high - surface.facts().low).norm()),
          patch_(smooth_patches(surface, edge_angle)) {
        find_parts();
        const bool any_closed = contains(part_closed_, 1);
        if (look_ == MeshLook::vessel && any_closed)
            room_.emplace(std::shared_ptr<const Surface>(std::shared_ptr<void>(), &surface_));
    }

    std::vector<MeshShape::Sides> find() {
        sides_.resize(patch_.size());
        ask();
        for (std::size_t part = 0; part < part_seen_.size(); ++part) {
            if (look_ == MeshLook::glass)
                settle(part, Face::glass, Face::glass);
            else if (look_ != MeshLook::solid && !part_closed_[part])
                settle_sheet(part);
            else if (settle_beside_room(part))
                continue;
            else if (look_ != MeshLook::solid && part_closed_[part] && is_shell(part))
                settle_shell(part);
            else if (look_ == MeshLook::vessel)
                settle_closed(part, Face::glass, Face::solid);
            else if (part_closed_[part])
                settle_closed(part, Face::solid, Face::unseen);
        }
        return sides_;
    }

  private:
    using Face = MeshShape::Face;

    // Finds the connected parts, and the triangles of each patch.
    void find_parts() {
        const std::vector<std::int32_t> part = smooth_patches(surface_, std::numbers::pi);
        const auto count = [](const std::vector<std::int32_t>& numbers) {
            return numbers.empty()
                       ? 0
                       : static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end())) + 1;
        };
        members_.resize(count(patch_));
        part_of_patch_.resize(members_.size());
        patch_seen_.resize(members_.size());
        part_seen_.resize(count(part));
        part_closed_.assign(part_seen_.size(), 1);
        visible_front_.assign(part_seen_.size(), 1);
        around_front_.assign(part_seen_.size(), 0);
        around_back_.assign(part_seen_.size(), 0);
        for (std::int32_t t = 0; t < surface_.size(); ++t) {
            const auto index = static_cast<std::size_t>(t), p = static_cast<std::size_t>(patch_[index]);
            members_[p].push_back(t);
            part_of_patch_[p] = static_cast<std::size_t>(part[index]);
            patch_seen_[p].area += surface_.area(t);
            for (int e = 0; e < 3; ++e)
                if (surface_.facts().open_edges > 0 && surface_.neighbour(t, e).triangle < 0)
                    part_closed_[part[index]] = 0;
        }
        patches_.resize(part_seen_.size());
        for (std::size_t p = 0; p < members_.size(); ++p) patches_[part_of_patch_[p]].push_back(p);
    }

    std::size_t part_of(std::int32_t t) const { return part_of_patch_[patch_[t]]; }

    Vec3 middle(std::int32_t t) const {
        return (surface_.corner(t, 0) + surface_.corner(t, 1) + surface_.corner(t, 2)) / 3;
    }

    double surface_seen(const Vec3& from, const Vec3& normal) const {
        static const std::array<Vec3, kRays> directions = make_directions();
        const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
        int met = 0;
        for (const Vec3& d : directions)
            met += surface_.first_hit(from, d.x() * u + d.y() * v + d.z() * normal).has_value();
        return static_cast<double>(met) / kRays;
    }

    void ask() {
        const std::size_t apart = members_.size() / kPlaces + 1;
        const std::size_t each =
            std::clamp(kPlaces / std::max<std::size_t>(members_.size(), 1), std::size_t{1}, kPlacesOfPatch);
        std::vector<char> asked(part_seen_.size(), 0);
        for (std::size_t p = 0; p < members_.size(); ++p) {
            Seen& seen = patch_seen_[p];
            const std::size_t part = part_of_patch_[p];
            if (p % apart == 0) {
                const std::size_t places = std::min(each, members_[p].size());
                for (std::size_t k = 0; k < places; ++k) {
                    const std::int32_t t = members_[p][(2 * k + 1) * members_[p].size() / (2 * places)];
                    if (part_closed_[part] && !std::exchange(asked[part], 1)) look_for_material(part, t);
                    ask_at(t, seen.area / static_cast<double>(places), seen);
                }
            }
            part_seen_[part].add(seen);
        }
    }

    void ask_at(std::int32_t t, double weight, Seen& seen) {
        const Vec3 normal = surface_.normal(t);
        seen.weight += weight;
        seen.front += weight * surface_seen(middle(t) + small_ * normal, normal);
        seen.back += weight * surface_seen(middle(t) - small_ * normal, -normal);
        if (!room_) return;
        seen.room_front += room_->holds(middle(t) + small_ * normal) ? weight : 0;
        seen.room_back += room_->holds(middle(t) - small_ * normal) ? weight : 0;
    }

    // Finds on which side of a closed part its material is: a ray from the side that can be seen crosses
    // surfaces an even number of times.
    void look_for_material(std::size_t part, std::int32_t t) {
        const Vec3 normal = surface_.normal(t);
        std::vector<Surface::Hit> hits;
        surface_.all_hits(middle(t) + small_ * normal, (normal + 0.1 * normal.unitOrthogonal()).normalized(),
                          hits);
        visible_front_[part] = hits.size() % 2 == 0;
        around_front_[part] = 0;
        for (const Surface::Hit& hit : hits)
            if (part_closed_[part_of(hit.triangle)]) around_front_[part] += hit.front ? -1 : 1;
        around_back_[part] = around_front_[part] + 1;
    }

    double visible_share(const Seen& seen, std::size_t part) const {
        return visible_front_[part] ? seen.front_share() : seen.back_share();
    }
    bool is_inner(std::size_t patch) const {
        return visible_share(patch_seen_[patch], part_of_patch_[patch]) >= kEnclosed;
    }

    // Settles a closed part of a vessel that has the room on one of its sides. Such a part is a sheet around
    // the room, even if bars and dents on its outer side see each other, or a body in the room. Returns
    // whether the part is one of these.
    bool settle_beside_room(std::size_t part) {
        const Seen& seen = part_seen_[part];
        const bool in_front = seen.room_front > seen.room_back;
        const double share = std::max(seen.room_front, seen.room_back) / std::max(seen.weight, 1e-300);
        const bool sheet = (in_front ? around_back_[part] : around_front_[part]) == 0;
        if (share < (sheet ? kHoldsRoom : kInRoom)) return false;
        const Face other = sheet ? Face::glass : Face::unseen;
        settle(part, in_front ? Face::solid : other, in_front ? other : Face::solid);
        return true;
    }

    bool is_shell(std::size_t part) const {
        const double least = look_ == MeshLook::vessel ? kEnclosed : kSurelyEnclosed;
        double inner = 0;
        for (const std::size_t p : patches_[part])
            if (visible_share(patch_seen_[p], part) >= least) inner += patch_seen_[p].area;
        return inner >= kShellShare * part_seen_[part].area;
    }

    void settle(std::size_t part, Face front, Face back) {
        for_triangles(part, [&](std::size_t, std::int32_t t) { sides_[t] = {front, back}; });
    }
    // Settles a closed part. out, in: the looks of its outer side, which can be seen, and of its inner side.
    void settle_closed(std::size_t part, Face out, Face in) {
        settle(part, visible_front_[part] ? out : in, visible_front_[part] ? in : out);
    }

    // Settles an open sheet. One of its sides may look into the room that the sheet holds.
    void settle_sheet(std::size_t part) {
        const double front = part_seen_[part].front_share(), back = part_seen_[part].back_share();
        const double least = look_ == MeshLook::vessel ? kDiffersInVessel : kDiffers;
        if (std::abs(front - back) < least) return;
        settle(part, front < back ? Face::glass : Face::solid, front < back ? Face::solid : Face::glass);
    }

    // Settles walls with a thickness. They are glass where the room is behind them; a rim is solid.
    void settle_shell(std::size_t part) {
        std::size_t last = members_.size();
        Face seen = Face::solid;
        for_triangles(part, [&](std::size_t p, std::int32_t t) {
            if (p != last) seen = !is_inner(p) && is_backed(p) ? Face::glass : Face::solid;
            last = p;
            const bool front = visible_front_[part];
            sides_[t] = {front ? seen : Face::unseen, front ? Face::unseen : seen};
        });
    }

    // Whether straight ways through the wall come out in the room from at least half of the places of the
    // patch.
    bool is_backed(std::size_t patch) const {
        const std::vector<std::int32_t>& all = members_[patch];
        const std::size_t places = std::min(all.size(), kPlacesOfPatch);
        std::size_t backed = 0;
        for (std::size_t k = 0; k < places; ++k) {
            const std::int32_t t = all[(2 * k + 1) * all.size() / (2 * places)];
            const double side = visible_front_[part_of_patch_[patch]] ? 1 : -1;
            const Vec3 normal = side * surface_.normal(t);
            const auto hit = surface_.first_hit(middle(t) - small_ * normal, -normal);
            if (hit) backed += is_inner(static_cast<std::size_t>(patch_[hit->triangle]));
        }
        return 2 * backed >= places;
    }

    template <class Visit>
    void for_triangles(std::size_t part, const Visit& visit) const {
        for (const std::size_t p : patches_[part])
            for (const std::int32_t t : members_[p]) visit(p, t);
    }

    const Surface& surface_;
    const MeshLook look_;
    const double small_;  // m, off the surface
    const std::vector<std::int32_t> patch_;
    std::vector<MeshShape::Sides> sides_;
    std::vector<std::vector<std::int32_t>> members_;  // the triangles of each patch
    std::vector<std::vector<std::size_t>> patches_;   // the patches of each part
    std::vector<std::size_t> part_of_patch_;
    std::vector<Seen> patch_seen_, part_seen_;
    std::vector<char> part_closed_, visible_front_;
    // For each part: how many closed parts enclose each of its sides.
    std::vector<int> around_front_, around_back_;
    std::optional<EnclosedRoom> room_;  // room of a vessel with closed parts
};

}  // namespace

std::vector<MeshShape::Sides> find_sides(const Surface& surface, double edge_angle, MeshLook look) {
    return SideFinder(surface, edge_angle, look).find();
}

}  // namespace grainreel
