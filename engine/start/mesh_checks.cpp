#include "engine/start/mesh_checks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/reach.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/drive_motion.hpp"

namespace grainreel {

namespace {

constexpr double kFarSideways = 10;  // times the box of the grains at the start
constexpr int kLooksDown = 200;      // most places along a fall at which meshes are looked for

// Where grains can be at most: a ball (m), and the same ball moved down by `fall`.
struct GrainReach {
    Vec3 centre{0, 0, 0};
    double radius = 0;
    Vec3 down{0, 0, 0};  // unit
    double fall = 0;     // m
};

bool is_closed_in(const Scene& scene) {
    const Container& c = scene.container;
    return c.shape != Container::Shape::none && c.shape != Container::Shape::mesh && !c.outlet;
}

Extent box_of_grains(const Scene& scene) {
    std::vector<Vec3> corners;
    const auto add = [&](const Vec3& low, const Vec3& high) {
        corners.push_back(low), corners.push_back(high);
    };
    if (scene.start.packs() && scene.start.region) add(scene.start.region->low, scene.start.region->high);
    if (const SceneMesh* vessel = scene.vessel())
        add(vessel->surface->facts().low, vessel->surface->facts().high);
    else if (scene.container.shape != Container::Shape::none)
        add(extent_of(scene).low, extent_of(scene).high);
    for (const Feed& feed : scene.feeds) add(feed.low, feed.high);
    for (const ListedGrain& grain : scene.start.grains) add(grain.position, grain.position);
    if (corners.empty()) return extent_of(scene);
    Extent box{corners.front(), corners.front()};
    for (const Vec3& corner : corners) box.take(corner);
    return box;
}

// Speed (m/s) of the fastest grains when they come into the scene.
double fastest_given(const Scene& scene) {
    double fastest = 0;
    for (const Feed& feed : scene.feeds) fastest = std::max(fastest, feed.velocity.norm());
    for (const ListedGrain& grain : scene.start.grains) fastest = std::max(fastest, grain.velocity.norm());
    return fastest;
}

GrainReach reach_of(const Scene& scene) {
    const Extent box = box_of_grains(scene);
    GrainReach reach;
    reach.centre = box.middle();
    reach.radius = 0.5 * box.size().norm() + largest_diameter(scene);
    if (scene.drive.present) reach.radius += 2 * scene.drive.largest_amplitude();
    if (is_closed_in(scene) && scene.container.lid) return reach;
    const double time = scene.run.duration, gravity = scene.gravity.norm();
    reach.radius += kFarSideways * box.size().norm() + fastest_given(scene) * time;
    if (gravity > 0 && !is_closed_in(scene)) {
        reach.down = scene.gravity / gravity;
        reach.fall = 0.5 * gravity * time * time;
    }
    return reach;
}

// Whether a reach is near a surface. The reach is moved into the body's frame, where the surface is at
// rest. `more` (m) widens it for the motion between two moments.
bool is_near(const Surface& surface, const BodyPose& pose, const GrainReach& reach, double more) {
    const double radius = reach.radius + more;
    const int looks = static_cast<int>(std::min<double>(kLooksDown, std::ceil(reach.fall / radius)));
    for (int k = 0; k <= looks; ++k)
        if (surface.any_within(pose.at_rest(reach.centre + k * radius * reach.down), radius)) return true;
    return false;
}

bool is_ever_near(const Scene& scene, const Plan& plan, const Body& body, const SceneMesh& mesh,
                  const GrainReach& reach) {
    const DriveMotion motion(scene.drive, plan.clock);
    const std::vector<std::int64_t> moments = moments_of(body, scene, plan);
    const double steps = static_cast<double>(moments.back()) / kMomentsOfMotion;
    const double more = moments.size() > 1 ? own_speed(mesh) * steps * plan.clock.step : 0;
    return std::any_of(moments.begin(), moments.end(), [&](std::int64_t step) {
        return is_near(*mesh.surface, body.at(motion.at(step)), reach, more);
    });
}

// A place where a grain of this radius would touch the mesh or lie in it, looked for on a grid over the
// feed's box.
std::optional<Vec3> touching_place(const Feed& feed, const SceneMesh& mesh, double radius) {
    constexpr int places = 11;  // along each axis
    for (int at = 0; at < places * places * places; ++at) {
        const Vec3 share = Vec3(at % places, at / places % places, at / (places * places)) / (places - 1);
        const Vec3 place = feed.low + share.cwiseProduct(feed.high - feed.low);
        if (mesh.surface->any_within(place, radius)) return place;
    }
    return {};
}

}  // namespace

void check_meshes_near(const Scene& scene, const Plan& plan) {
    if (scene.start.method == Start::Method::file && scene.container.shape == Container::Shape::none) return;
    const GrainReach reach = reach_of(scene);
    const std::vector<Body> bodies = bodies_of(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const Body& body = bodies[static_cast<std::size_t>(first_mesh_body(scene)) + m];
        if (is_ever_near(scene, plan, body, mesh, reach)) continue;
        const MeshFacts& facts = mesh.surface->facts();
        const bool millimetres = mesh.scale == 1 && (facts.high - facts.low).maxCoeff() > reach.radius;
        throw UserError(
            "{}: the mesh \"{}\" is far from all grains: it lies between ({:.4g}, {:.4g}, {:.4g}) and "
            "({:.4g}, "
            "{:.4g}, {:.4g}) m, and no grain comes further than {:.3g} m from ({:.4g}, {:.4g}, {:.4g}) m{}; "
            "{}",
            scene.where(fmt::format("mesh[{}].file", m)), mesh.name, facts.low.x(), facts.low.y(),
            facts.low.z(), facts.high.x(), facts.high.y(), facts.high.z(), reach.radius, reach.centre.x(),
            reach.centre.y(), reach.centre.z(), reach.fall > 0 ? ", or from below that" : "",
            millimetres ? "if its file is in millimetres, write scale = 0.001"
                        : "change its 'position' or 'scale', or leave it out");
    }
}

// Checks feeds against meshes. Of a vessel a feed uses only the room inside (Feeder).
void check_feed_boxes(const Scene& scene) {
    for (std::size_t k = 0; k < scene.feeds.size(); ++k) {
        const Feed& feed = scene.feeds[k];
        const double diameter = scene.species[feed.species].diameter.largest;
        for (const SceneMesh& mesh : scene.meshes) {
            if (&mesh == scene.vessel()) continue;
            const std::optional<Vec3> place = touching_place(feed, mesh, 0.5 * diameter);
            if (!place) continue;
            throw UserError(
                "{}: the box of this feed reaches into the mesh \"{}\": at ({:.4g}, {:.4g}, {:.4g}) m "
                "a grain of {:.4g} m across would touch it; move 'low' and 'high' away from it",
                scene.where(fmt::format("feed[{}].low", k)), mesh.name, place->x(), place->y(), place->z(),
                diameter);
        }
    }
}

void check_meshes(const Scene& scene, Plan& plan) {
    if (scene.meshes.empty()) return;
    check_meshes_near(scene, plan);
    check_feed_boxes(scene);
    check_mesh_paths(scene, plan);
}

}  // namespace grainreel
