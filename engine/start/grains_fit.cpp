// Whether the grains of a file or a list lie where grains can be: inside the container, off its walls, off
// each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.hpp"
#include "engine/start/start_file.hpp"
#include "engine/step/wall_name.hpp"

namespace grainreel {

namespace {

constexpr double kTooDeep = 1.0 / 3;
// A table does not say where the walls were.
constexpr const char* kOtherContainer =
    "give the container of the run the file comes from, and the checkpoint of a run that did not end with a "
    "period";

bool is_listed(const Scene& scene) {
    return scene.start.method == Start::Method::grains;
}

// At the grain in the scene's list, or at the start file.
[[noreturn]] void fail(const Scene& scene, std::int32_t id, const std::string& what) {
    if (is_listed(scene))
        throw UserError(fmt::format("{}: the grain {}; move one of the two",
                                    scene.where(fmt::format("grain[{}]", id)), what));
    throw UserError(fmt::format("{}: grain {} of '{}' {}; {}", scene.where("start.file"), id,
                                scene.start.file, what, kOtherContainer));
}

void check_faces(const Scene& scene, const std::vector<Face>& faces, const Grains& grains, std::size_t i) {
    for (const Face& face : faces) {
        if (distance_to(face, Vec3::Zero(), grains.place[i].position).distance > 0) continue;
        const std::string beyond = fmt::format("beyond the {}", face.name);
        fail(scene, grains.id[i],
             is_listed(scene) ? "lies " + beyond : "lies outside the container, " + beyond);
    }
}

// Whether a ray from there crosses the surface an odd number of times, in a direction that no mesh has edges
// along.
bool is_within(const Surface& surface, const Vec3& place) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(place, Vec3(0.3713906763541037, 0.5570860145311556, 0.7427813527082074), hits);
    return hits.size() % 2 == 1;
}

// Why no grain can lie there, at rest; empty where one can. In a closed vessel all but its room is forbidden.
// Around an open one grains may lie. In another closed mesh they may not.
std::string forbidden(const Scene& scene, const MeshWall& mesh, const Vec3& place) {
    if (!mesh.surface->facts().closed()) return "";
    const bool vessel = scene.vessel() != nullptr && scene.vessel()->name == mesh.name;
    if (vessel && scene.container.room->holds(place)) return "";
    if (is_within(*mesh.surface, place)) return fmt::format("lies inside the mesh \"{}\"", mesh.name);
    if (!vessel || scene.container.room->open_above()) return "";
    return fmt::format("lies outside the vessel \"{}\"", mesh.name);
}

void check_meshes(const Scene& scene, const std::vector<MeshWall>& meshes, const Grains& grains,
                  std::size_t i) {
    const Place& grain = grains.place[i];
    for (const MeshWall& mesh : meshes) {
        const Vec3 place = mesh.body.at(Pose()).at_rest(grain.position);
        if (const std::string why = forbidden(scene, mesh, place); !why.empty())
            fail(scene, grains.id[i], why);
        const auto nearest = mesh.surface->nearest(place, (1 - kTooDeep) * grain.radius);
        if (!nearest) continue;
        const double overlap = 1 - std::sqrt(nearest->point.squared) / grain.radius;
        fail(scene, grains.id[i],
             fmt::format("overlaps the mesh \"{}\" by {:.2f} of its radius", mesh.name, overlap));
    }
}

}  // namespace

void check_grains_fit(const Scene& scene, const Surroundings& around, const Grains& grains) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        check_faces(scene, around.faces, grains, i);
        check_meshes(scene, around.meshes, grains, i);
    }
}

void check_grains_clear(const Scene& scene, const Surroundings& around, const Grains& grains,
                        const StepLoop& loop) {
    const bool listed = is_listed(scene);
    const auto reject = [&](const std::string& what) {
        if (listed) throw UserError(fmt::format("{}: the list {}", scene.where("grain"), what));
        throw UserError(fmt::format("{}: '{}' {}", scene.where("start.file"), scene.start.file, what));
    };
    loop.visit_contacts(-1, [&](const ContactView& c) {
        if (c.overlap <= kTooDeep * c.smaller_radius) return;
        const double share = c.overlap / c.smaller_radius;
        if (c.second < 0)
            reject(fmt::format("has grain {} overlapping {} by {:.2f} of its radius; {}", grains.id[c.first],
                               wall_name(around, -1 - c.second), share,
                               listed ? "move one of the two" : kOtherContainer));
        reject(fmt::format("has grains {} and {} overlapping by {:.2f} of the smaller radius; {}",
                           std::min(grains.id[c.first], grains.id[c.second]),
                           std::max(grains.id[c.first], grains.id[c.second]), share,
                           listed ? "move one of them" : "take the file of another run"));
    });
}

}  // namespace grainreel
