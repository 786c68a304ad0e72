// What can be wrong with meshes, exits and turning containers that are right by themselves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/vessel_leak.hpp"

namespace grainreel {
namespace {

using Shape = Container::Shape;

// Faces of containers and trays, whatever the container; a mesh of such a name would share their columns.
constexpr std::array<std::string_view, 10> kFaces{
    "wall", "floor", "lid", "left wall", "right wall", "left slant", "right slant", "back", "front", "tray"};

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError(fmt::format("{}: '{}' {}", scene.where(key), name_of(key), what));
}

std::string key_of(std::size_t mesh, const char* name) {
    return fmt::format("mesh[{}].{}", mesh, name);
}

// Who else has a mesh's name; empty: nobody.
std::string holder_of(const Scene& scene, std::size_t mesh) {
    std::string name = scene.meshes[mesh].name;
    std::replace(name.begin(), name.end(), '_', ' ');
    const auto is_face = [&](std::string_view face) {
        return name == face || (face == "tray" && name.starts_with("tray "));
    };
    if (std::any_of(kFaces.begin(), kFaces.end(), is_face)) return "a face of containers";
    const std::string& own = scene.meshes[mesh].name;
    for (const Species& species : scene.species)
        if (species.name == own) return "a species";
    for (const FreeWall& wall : scene.walls)
        if (wall.name == own) return "a plane";
    for (std::size_t other = 0; other < mesh; ++other)
        if (scene.meshes[other].name == own) return "another mesh";
    return "";
}

void check_mesh_names(const Scene& scene) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const std::string& name = scene.meshes[m].name;
        if (name.find_first_not_of(' ') == std::string::npos)
            fail(scene, key_of(m, "name"), "must not be empty; write for example \"drum\"");
        if (const std::string holder = holder_of(scene, m); !holder.empty())
            fail(scene, key_of(m, "name"),
                 fmt::format("\"{}\" is the name of {}; choose another", excerpt(name), holder));
    }
}

void check_paths(const Scene& scene) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (mesh.path && clearly_less(mesh.path->last(), scene.run.duration))
            fail(scene, key_of(m, "path"),
                 fmt::format(
                     "ends at {:.6g} s, but the run ends at {:.6g} s (run.duration); add rows to {}, or "
                     "shorten the run",
                     mesh.path->last(), scene.run.duration, excerpt(mesh.path_file)));
    }
}

// What neither turning walls nor meshes go together with.
void check_company(const Scene& scene) {
    const Container& c = scene.container;
    if (c.periodic_depth && !scene.meshes.empty())
        fail(scene, "container.periodic_depth",
             "cannot stand beside a [[mesh]], which would have to go on across the boundary; take one out");
    if (c.shape == Shape::mesh && scene.drive.present && scene.drive.moves == Drive::Moves::floor)
        fail(scene, "drive.moves",
             "is \"floor\", but a mesh has no floor of its own; make the floor a mesh with driven = true and "
             "the "
             "container one with driven = false");
}

void check_turn(const Scene& scene) {
    const Container& c = scene.container;
    if (!c.turn) return;
    const auto refuse = [&](const char* what, const char* instead) {
        fail(scene, "container.turn", fmt::format("cannot stand beside {}; {}", what, instead));
    };
    if (c.outlet)
        refuse("'outlet'", "take one out, or make the container a [[mesh]] and let grains leave by [[exit]]");
    if (c.tray) refuse("'tray'", "take one out");
    if (c.wall_grains) refuse("'wall_grains'", "take one out, or make the container a [[mesh]] with lifters");
    if (c.periodic_depth) refuse("'periodic_depth'", "give it front and back walls");
    if (scene.drive.present && scene.drive.moves == Drive::Moves::floor)
        refuse("drive.moves = \"floor\"", "take one out, or make the container of [[mesh]]es");
    if (c.shape != Shape::cylinder) return;
    const double off = std::hypot(c.turn->axis.x(), c.turn->axis.y());
    const double beside = std::hypot(c.turn->through.x(), c.turn->through.y());
    if (off > kSameDecimals || beside > kSameDecimals * c.half_width)
        fail(scene, off > kSameDecimals ? "container.turn.axis" : "container.turn.through",
             "must be the cylinder's own axis, z through its middle; lay a drum on its side by the direction "
             "of "
             "gravity, as in gravity = [0, -9.81, 0], or take a [[mesh]]");
}

double smallest_diameter(const Scene& scene) {
    double smallest = scene.species.front().diameter.smallest;
    for (const Species& species : scene.species) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

// Grains leave a vessel only where the scene says so.
void check_vessel(const Scene& scene) {
    const SceneMesh* vessel = scene.vessel();
    if (vessel == nullptr || !scene.exits.empty()) return;
    const auto leak = leak_of(*vessel->surface, *scene.container.room, smallest_diameter(scene));
    if (!leak) return;
    fail(
        scene, "container.mesh",
        fmt::format("names \"{}\", which leaks near ({:.4g}, {:.4g}, {:.4g}) m; close the hole, or say by an "
                    "[[exit]] where grains leave",
                    excerpt(vessel->name), leak->x(), leak->y(), leak->z()));
}

}  // namespace

void check_meshes(const Scene& scene) {
    check_mesh_names(scene);
    check_company(scene);
    check_turn(scene);
    check_paths(scene);
    check_vessel(scene);
}

std::vector<std::string> doubts_of_meshes(const Scene& scene) {
    constexpr double too_large = 3000, too_small = 0.5;  // over the largest and the smallest grain
    std::vector<std::string> doubts;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const double size = (mesh.surface->facts().high - mesh.surface->facts().low).maxCoeff();
        const double largest = largest_diameter(scene), smallest = smallest_diameter(scene);
        const std::string start = fmt::format("{}: the mesh \"{}\" is {:.4g} m large",
                                              scene.where(key_of(m, "scale")), mesh.name, size);
        if (size > too_large * largest)
            doubts.push_back(
                fmt::format("{}, beside grains of {:.4g} m; where its file is in mm, write scale = {:.4g}",
                            start, largest, 0.001 * mesh.scale));
        if (size < too_small * smallest)
            doubts.push_back(
                fmt::format("{}, smaller than the smallest grain, {:.4g} m; is its scale the one you mean?",
                            start, smallest));
    }
    return doubts;
}

}  // namespace grainreel
