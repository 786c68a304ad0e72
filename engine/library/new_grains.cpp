#include "engine/library/new_grains.hpp"

#include <fmt/format.h>

#include "engine/base/numbers.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/text/units.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel::v1 {
namespace {

// A radius may be beyond the bounds of its species by rounding.
constexpr double kSameSize = 1e-9;

// Where a grain lies, for messages.
std::string words_of(const Vec3& place) {
    return fmt::format("a new grain at ({:.4g}, {:.4g}, {:.4g}) m", place.x(), place.y(), place.z());
}

[[noreturn]] void refuse(const grainreel::ComingGrain& grain, const std::string& why) {
    throw Error(fmt::format("{} {}; choose a free place", words_of(grain.position), why));
}

void check_radius(const NewGrain& grain, const Species& kind) {
    const double least = 0.5 * kind.diameter.smallest, most = 0.5 * kind.diameter.largest;
    if (grain.radius >= least * (1 - kSameSize) && grain.radius <= most * (1 + kSameSize)) return;
    throw Error(fmt::format("a new grain has a radius of {} m; those of {} have {} to {} m", grain.radius,
                            kind.name, least, most));
}

// The same bounds as in a scene file. 0 stands for the density of the species.
void check_density(const NewGrain& grain) {
    const DimensionText& bounds = text_of(Dimension::density);
    if (grain.density == 0 || (grain.density >= bounds.least && grain.density <= bounds.most)) return;
    throw Error(
        fmt::format("a new grain has a density of {} kg/m3; it must be from {} to {}, or 0 for that of its "
                    "species",
                    grain.density, bounds.least, bounds.most));
}

grainreel::ComingGrain grain_inside(const NewGrain& grain, const grainreel::Scene& scene) {
    if (grain.species < 0 || grain.species >= std::ssize(scene.species))
        throw Error(fmt::format("a new grain is of species {}; there are {}, which count from 0",
                                grain.species, scene.species.size()));
    const Species& kind = scene.species[grain.species];
    check_radius(grain, kind);
    check_density(grain);
    grainreel::ComingGrain inner;
    inner.species = grain.species;
    inner.radius = grain.radius;
    inner.density = grain.density > 0 ? grain.density : kind.density;
    inner.position = inside(grain.position);
    inner.velocity = inside(grain.velocity);
    inner.spin = inside(grain.spin);
    if (!inner.position.allFinite() || !inner.velocity.allFinite() || !inner.spin.allFinite())
        throw Error("a new grain has a place, a velocity or a spin that is no number");
    constexpr double farthest = 1e9;  // radii: farther out a double is too coarse for overlaps
    if (inner.position.cwiseAbs().maxCoeff() > farthest * inner.radius)
        refuse(inner, "is so far out that its place is not exact any more");
    return inner;
}

}  // namespace

RoomForGrains::RoomForGrains(const grainreel::Scene& scene, const Plan& plan, const grainreel::State& now)
    : scene_(scene), now_(now), around_(make_surroundings(scene, plan)), pose_(around_.motion.at(now.step)) {
    if (plan.opens && now.step >= *plan.opens) open_outlet(scene, around_);
}

void RoomForGrains::check_walls(const grainreel::ComingGrain& grain) const {
    for (const Face& face : around_.faces) {
        const double distance = distance_at(face, pose_, grain.position).distance;
        if (distance >= grain.radius) continue;
        refuse(grain, fmt::format("{} the {}", distance > 0 ? "touches" : "lies beyond", face.name));
    }
    for (std::size_t g = 0; g < around_.glued.size(); ++g)
        check_other(grain, around_.glued.centre(g, around_.faces, pose_), around_.glued.place[g].radius,
                    "a grain that is glued to a wall");
}

void RoomForGrains::check_meshes(const grainreel::ComingGrain& grain) const {
    for (const MeshWall& mesh : around_.meshes) {
        const Vec3 place = mesh.body.at(pose_).at_rest(grain.position);
        if (const std::string why = why_no_grain_at(scene_, mesh, place); !why.empty()) refuse(grain, why);
        if (mesh.surface->any_within(place, grain.radius))
            refuse(grain, fmt::format("touches the mesh \"{}\"", mesh.name));
    }
}

void RoomForGrains::check_other(const grainreel::ComingGrain& grain, const Vec3& other, double radius,
                                const char* what) const {
    Vec3 between = grain.position - other;
    between.x() = wrapped(between.x(), around_.period);
    if (between.norm() < grain.radius + radius) refuse(grain, fmt::format("touches {}", what));
}

grainreel::ComingGrain RoomForGrains::take(const NewGrain& grain) {
    const grainreel::ComingGrain inner = grain_inside(grain, scene_);
    check_walls(inner);
    check_meshes(inner);
    for (std::size_t i = 0; i < now_.size(); ++i)
        check_other(inner, now_.position[i], now_.radius[i], "another");
    for (const grainreel::ComingGrain& other : taken_)
        check_other(inner, other.position, other.radius, "another new one");
    taken_.push_back(inner);
    return inner;
}

}  // namespace grainreel::v1
