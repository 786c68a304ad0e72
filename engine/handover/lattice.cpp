// Places for grains that another engine packs: apart from each other and from all walls, from the bottom up.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/state/glued_grains.hpp"

namespace grainreel {

std::vector<Vec3> lattice_places(const CarriedScene& carried, std::size_t count, double largest);

namespace {

// The loosest lattice that fits; over the largest diameter. Its grains are moved at random by what is left.
constexpr double kSpacings[] = {1.25, 1.15, 1.08, 1.02};

struct RoomOfLattice {
    explicit RoomOfLattice(const CarriedScene& scene) : carried(scene), space(scene.scene) {
        const Container& c = scene.scene.container;
        const double depth = c.shape == Container::Shape::cylinder ? 2 * c.half_width : c.depth;
        low = Vec3(-depth / 2, -c.half_width, c.base());
        high = Vec3(depth / 2, c.half_width, c.lid ? c.height : 100 * c.height);
        if (scene.scene.start.region) {
            low = scene.scene.start.region->low;
            high = scene.scene.start.region->high;
        }
        glued = scene.plan.glued.empty() ? 0 : scene.types.back().largest / 2;
    }
    bool holds(const Vec3& place, double margin) const {
        if (!carried.scene.meshes.empty()) return space.holds(place, margin);
        for (const Face& face : carried.faces) {
            const double from_glued = face.body.number == kTrayBody ? 0 : glued;
            if (distance_at(face, Pose(), place).distance < margin + from_glued) return false;
        }
        return true;
    }
    const CarriedScene& carried;
    FreeSpace space;
    Vec3 low, high;
    double glued = 0;  // m, how far glued grains reach into the room
};

bool fill(const RoomOfLattice& room, double spacing, double jitter, double radius, std::size_t count,
          std::uint64_t seed, std::vector<Vec3>& places) {
    Random random(seed, Stream::centres, {1});
    const double margin = radius + jitter;
    const Vec3 size = room.high - room.low;
    // Across a periodic depth the lattice closes.
    const double along =
        std::max(1.0, std::floor((size.x() - (room.carried.periodic ? 0 : 2 * margin)) / spacing +
                                 (room.carried.periodic ? 0 : 1)));
    const double dx = room.carried.periodic ? size.x() / along : spacing;
    const double x0 = room.carried.periodic ? room.low.x() + dx / 2 : -(along - 1) * dx / 2;
    places.clear();
    for (double z = room.low.z() + margin; z <= room.high.z() - margin; z += spacing)
        for (double y = room.low.y() + margin; y <= room.high.y() - margin; y += spacing)
            for (double i = 0; i < along; ++i) {
                const Vec3 place(x0 + i * dx, y, z);
                if (!room.holds(place, margin)) continue;
                const Vec3 off(random.between(-jitter, jitter), random.between(-jitter, jitter),
                               random.between(-jitter, jitter));
                places.push_back(place + off);
                if (places.size() == count) return true;
            }
    return false;
}

}  // namespace

std::vector<Vec3> lattice_places(const CarriedScene& carried, std::size_t count, double largest) {
    const RoomOfLattice room(carried);
    std::vector<Vec3> places;
    for (const double spacing : kSpacings)
        if (fill(room, spacing * largest, 0.49 * (spacing - 1) * largest, largest / 2, count,
                 carried.scene.run.seed, places))
            return places;
    throw UserError(fmt::format(
        "{}: {} grains do not fit the container without touching, as they must where the other engine packs; "
        "let ours pack (--pack-there above {}), or take the lid off",
        carried.scene.where("start"), count, count));
}

}  // namespace grainreel
