#include "engine/start/starting_room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/state/glued_grains.hpp"

namespace grainreel {

namespace {

constexpr double kLooseFraction = 1.0 / 3;  // solid share of the space in which centres are drawn

constexpr int kMostDraws = 1000;  // draws of a place outside all glued grains, which may cover a thin layer

// The grains fill only a part of the space, so that they soon come apart.
double loosely_filled(const Scene& scene, const FreeSpace& space) {
    double solid = 0;
    for (const Species& species : scene.species) solid += solid_volume_at_start(species);
    return std::min(1.0, solid / kLooseFraction / space.volume());
}

}  // namespace

double solid_volume_at_start(const Species& species) {
    const double mean_diameter = 0.5 * (species.diameter.smallest + species.diameter.largest);
    return static_cast<double>(species.count) * std::numbers::pi / 6 * math::cube(mean_diameter);
}

StartingRoom::StartingRoom(const Scene& scene)
    : space(scene),
      filled(loosely_filled(scene, space)),
      simple_(scene.meshes.empty() && !scene.start.region),
      meshes_(scene.meshes),
      place_(scene.where("start")),
      faces_(faces_of(scene)),
      glued_(glue_grains(scene, faces_)),
      search_(glued_, faces_, period_of_depth(scene.container)) {}

Vec3 StartingRoom::random_centre(double bottom, double top, double margin, double radius,
                                 Random& random) const {
    const Vec3 &low = space.low(), &high = space.high();
    for (int draws = 1;; ++draws) {
        const double z = random.between(bottom, top);
        // y before x on every compiler (see Random::in_cube())
        const double y = random.between(low.y(), high.y());
        const Vec3 centre(random.between(low.x(), high.x()), y, z);
        if (draws % kMostDraws == 0 && !simple_) margin = narrower(margin, draws);
        if (!space.holds(centre, margin)) continue;
        if (draws > kMostDraws || (is_clear(centre, margin) && !is_wedged(centre, radius))) return centre;
    }
}

// The margin shrinks with the number of draws, because a mesh or a region may leave only narrow places.
double StartingRoom::narrower(double margin, int draws) const {
    if (draws < kMostDraws * kMostDraws) return 0.5 * margin;
    throw UserError(
        "{}: no place was found for a grain in {} draws: the vessel or the region leaves hardly "
        "any room; make it larger, or take method = \"rain\"",
        place_, draws);
}

bool StartingRoom::is_clear(const Vec3& centre, double margin) const {
    bool clear = true;
    search_.near(centre, margin, DrivePose(), [&](std::int32_t, double) { clear = false; });
    return clear;
}

// Whether a mesh and a wall that faces it leave less room than a grain's diameter. Radius growth cannot
// push a grain out of such a gap, because both walls push against each other.
bool StartingRoom::is_wedged(const Vec3& centre, double radius) const {
    constexpr double kFacing = 0.85;  // cosine
    for (const SceneMesh& mesh : meshes_) {
        const auto nearest = mesh.surface->nearest(centre, 2 * radius);
        if (!nearest || !(nearest->point.squared > 0)) continue;
        const double distance = std::sqrt(nearest->point.squared), room = 2 * radius - distance;
        const Vec3 away = (centre - nearest->point.at) / distance;
        for (const SceneMesh& other : meshes_) {
            const auto hit = other.surface->first_hit(centre, away);
            if (hit && hit->distance < room &&
                std::abs(other.surface->normal(hit->triangle).dot(away)) > kFacing)
                return true;
        }
        for (const Face& face : faces_) {
            const FaceDistance to = distance_to(face, Vec3::Zero(), centre);
            if (-to.normal.dot(away) > kFacing && to.distance < room) return true;
        }
    }
    return false;
}

}  // namespace grainreel
