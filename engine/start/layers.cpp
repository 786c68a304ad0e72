#include "engine/start/layers.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/step/grid/neighbours.hpp"

namespace grainreel {

namespace {

constexpr double kLooseFraction = 1.0 / 3;  // solid share of the space in which centres are drawn

constexpr int kMostDraws = 1000;  // draws of a place outside all glued grains, which may cover a thin layer

// The space where centres may be drawn: the free space without the glued grains.
class Room {
  public:
    explicit Room(const Scene& scene)
        : space(scene),
          simple_(scene.meshes.empty() && !scene.start.region),
          meshes_(scene.meshes),
          place_(scene.where("start")),
          faces_(faces_of(scene)),
          glued_(glue_grains(scene, faces_)),
          search_(glued_, faces_, period_of_depth(scene.container)) {}

    Vec3 random_centre(double bottom, double top, double margin, double radius, Random& random) const {
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

    const FreeSpace space;

  private:
    // The margin shrinks with the number of draws, because a mesh or a region may leave only narrow places.
    double narrower(double margin, int draws) const {
        if (draws < kMostDraws * kMostDraws) return 0.5 * margin;
        throw UserError(fmt::format(
            "{}: no place was found for a grain in {} draws: the vessel or the region leaves hardly "
            "any room; make it larger, or take method = \"rain\"",
            place_, draws));
    }

    bool is_clear(const Vec3& centre, double margin) const {
        bool clear = true;
        search_.near(centre, margin, DrivePose(), [&](std::int32_t, double) { clear = false; });
        return clear;
    }

    // Whether a mesh and a wall that faces it leave less room than a grain's diameter. Radius growth cannot
    // push a grain out of such a gap, because both walls push against each other.
    bool is_wedged(const Vec3& centre, double radius) const {
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

    const bool simple_;  // no mesh and no region: every layer has room
    const std::vector<SceneMesh>& meshes_;
    const std::string place_;  // place in the scene, for messages
    const std::vector<Face> faces_;
    const GluedGrains glued_;
    const GluedSearch search_;
};

double mean_diameter(const Species& s) {
    return 0.5 * (s.diameter.smallest + s.diameter.largest);
}

double solid_volume(const Species& s) {
    return static_cast<double>(s.count) * std::numbers::pi / 6 * math::cube(mean_diameter(s));
}

}  // namespace

Grains place_in_layers(const Scene& scene) {
    if (scene.grains_at_start() == 0) return {};
    std::vector<std::size_t> upwards(scene.species.size());
    std::iota(upwards.begin(), upwards.end(), std::size_t{0});
    std::stable_sort(upwards.begin(), upwards.end(), [&](std::size_t a, std::size_t b) {
        return mean_diameter(scene.species[a]) > mean_diameter(scene.species[b]);
    });
    double all = 0;
    for (const Species& s : scene.species) all += solid_volume(s);
    const Room room(scene);
    const FreeSpace& space = room.space;
    const double filled = std::min(1.0, all / kLooseFraction / space.volume());
    std::vector<double> bottom(scene.species.size()), top(scene.species.size());
    double share = 0;
    for (const std::size_t s : upwards) {
        bottom[s] = space.height_of_share(filled * share);
        share += solid_volume(scene.species[s]) / all;
        top[s] = space.height_of_share(filled * std::min(share, 1.0));
    }

    Random diameters(scene.run.seed, Stream::diameters), centres(scene.run.seed, Stream::centres);
    Grains grains;
    grains.reserve(scene.grains());
    std::int32_t id = 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        const Species& species = scene.species[s];
        for (std::int64_t k = 0; k < species.count; ++k) {
            const double radius = 0.5 * draw_diameter(species.diameter, diameters);
            const double off = scene.meshes.empty() ? 0.25 : 0.5;  // no mesh pushes grains back
            const double margin = std::min(off * radius, 0.25 * (top[s] - bottom[s]));
            const Vec3 centre = room.random_centre(bottom[s], top[s], margin, radius, centres);
            grains.add(id++, static_cast<std::int32_t>(s), centre, radius, species.density);
        }
    }
    return grains;
}

}  // namespace grainreel
