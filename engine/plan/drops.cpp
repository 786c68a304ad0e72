#include "engine/plan/drops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/free_space.hpp"

namespace grainreel {
namespace {

constexpr double loose_fraction = 1.0 / 3;  // solid, of the crowd that layers begin as

Vec3 up_of(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    return gravity > 0 ? Vec3(-scene.gravity / gravity) : Vec3(0, 0, 1);
}

// Where grains are listed, the space that is looked at says how far they fall, with planes and with meshes.
bool is_space_with_meshes(const Scene& scene) {
    return scene.container.shape == Container::Shape::none && !scene.meshes.empty() &&
           scene.start.grains.empty();
}

// The container's box; of a vessel the part of its box that is room.
Region box_of(const Container& c, const SceneMesh* vessel) {
    const double x = c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth;
    if (vessel == nullptr) return {Vec3(-x, -c.half_width, 0), Vec3(x, c.half_width, c.height)};
    Region box{vessel->surface->facts().low, vessel->surface->facts().high};
    box.low.z() = c.base(), box.high.z() = c.height;
    return box;
}

// m: the top of what starts in the region. Where gravity is along z, that is the top of a loose crowd.
double top_of_region(const Scene& scene) {
    const Region& region = *scene.start.region;
    if (up_of(scene) != Vec3(0, 0, 1)) return highest_corner(scene, region.low, region.high);
    const FreeSpace room(scene);
    const double share = room.volume() > 0 ? solid_volume(scene) / loose_fraction / room.volume() : 1;
    return room.height_of_share(std::min(1.0, share));
}

}  // namespace

double highest_corner(const Scene& scene, const Vec3& low, const Vec3& high) {
    const Vec3 up = up_of(scene);
    return up.cwiseProduct(low).cwiseMax(up.cwiseProduct(high)).sum();
}

double lowest_corner(const Scene& scene, const Vec3& low, const Vec3& high) {
    const Vec3 up = up_of(scene);
    return up.cwiseProduct(low).cwiseMin(up.cwiseProduct(high)).sum();
}

double bed_depth(const Scene& scene) {
    if (!is_space_with_meshes(scene)) return fill_height(scene, settled_solid_fraction);
    const double volume = solid_volume(scene) / settled_solid_fraction;
    if (!scene.start.region) return std::cbrt(volume);
    const Vec3 size = scene.start.region->high - scene.start.region->low;
    return std::min(volume / (size.x() * size.y()), size.z());
}

double lowest_wall(const Scene& scene) {
    if (scene.meshes.empty()) return 0;
    const bool space = scene.container.shape == Container::Shape::none && scene.walls.empty();
    double lowest = std::numeric_limits<double>::infinity();
    if (!space) {
        const Region box = box_of(scene.container, scene.vessel());
        lowest = lowest_corner(scene, box.low, box.high);
    }
    for (const SceneMesh& mesh : scene.meshes) {
        if (&mesh == scene.vessel()) continue;
        const MeshFacts& facts = mesh.surface->facts();
        lowest = std::min(lowest, lowest_corner(scene, facts.low, facts.high));
    }
    return lowest;
}

double start_drop(const Scene& scene, double depth) {
    const Container& c = scene.container;
    if (scene.start.region && scene.start.packs())
        return std::max(0.0, top_of_region(scene) - lowest_wall(scene));
    if (!is_space_with_meshes(scene)) return c.height - c.base() - depth;
    return 0;  // all are fed
}

double drop_below(const Scene& scene) {
    if (scene.meshes.empty()) return 0;
    if (scene.start.region)
        return std::max(0.0, lowest_corner(scene, scene.start.region->low, scene.start.region->high) -
                                 lowest_wall(scene));
    if (scene.container.shape == Container::Shape::none) return 0;
    const Region box = box_of(scene.container, scene.vessel());
    return std::max(0.0, lowest_corner(scene, box.low, box.high) - lowest_wall(scene));
}

}  // namespace grainreel
