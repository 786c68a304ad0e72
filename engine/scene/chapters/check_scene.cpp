// Checks values against each other: values that are allowed alone may be wrong together.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/output.hpp"

namespace grainreel {

namespace {

// The largest share of the container's volume that spheres growing in layers fill without jamming. A random
// packing of equal spheres has at most 0.64. Near 0.55 it can still be sheared.
constexpr double most_solid = 0.55;
constexpr double closest_packing = 0.64;  // solid fraction of a random packing of equal spheres

// The shortest period, in diameters of the largest grain. With two diameters or more no grain touches two
// images of another. Neighbour lists may reach half a diameter beyond contact, so they need that much more.
constexpr double shortest_period = 2.5;

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError("{}: '{}' {}", scene.where(key), name_of(key), what);
}

// Names that differ only in commas or quotes would share their columns of measures.csv.
void check_columns(const Scene& scene) {
    std::set<std::string> columns;
    for (const MeasureColumn& column : scene.measurable.columns)
        if (!columns.insert(column.name).second)
            throw UserError(
                "{}: the names of the species give measures.csv the column \"{}\" twice; choose "
                "names that differ in letters",
                scene.where("species"), excerpt(column.name));
}

void check_names(const Scene& scene) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        const std::string key = fmt::format("species[{}].name", i);
        const std::string& name = scene.species[i].name;
        if (trimmed(name, " ").empty()) fail(scene, key, "must not be empty; write for example \"small\"");
        if (name == "wall")
            fail(scene, key, "must not be \"wall\", which stands for the container; choose another");
        // "big " and "big" look alike.
        if (!names.insert(std::string(trimmed(name, " "))).second)
            fail(scene, key, fmt::format("\"{}\" is taken; choose another", excerpt(name)));
    }
    check_columns(scene);
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    if (scene.grains() > most)
        throw UserError("{}: {} grains are more than the {} that can be numbered; use fewer",
                        scene.where("species"), scene.grains(), most);
}

void check_wedge(const Scene& scene) {
    const Container& c = scene.container;
    if (c.shape != Container::Shape::wedge) return;
    if (c.half_angle >= std::numbers::pi / 2)
        fail(scene, "container.half_angle",
             fmt::format("must be less than 90 deg, but is {:.6g} deg{}",
                         c.half_angle * 180 / std::numbers::pi,
                         c.half_angle > 2 * std::numbers::pi && c.half_angle < 90
                             ? fmt::format("; a bare number is in rad, write \"{:.6g} deg\"", c.half_angle)
                             : ""));
    if (clearly_more(c.slant_height, c.height))
        fail(scene, "container.slant_height",
             fmt::format(
                 "is {:.6g} m, more than the height of the container, {:.6g} m; lower it or raise the height",
                 c.slant_height, c.height));
    const double taken = c.slant_height * math::tan(c.half_angle);
    if (clearly_less(c.half_width, taken))
        fail(
            scene, "container.half_width",
            fmt::format(
                "is {:.6g} m, but the slanted walls take {:.6g} m on each side and would cross; widen it, or "
                "reduce half_angle or slant_height",
                c.half_width, taken));
}

void check_grain_sizes_in_mesh(const Scene& scene) {
    const Container& c = scene.container;
    const double across = std::min({c.height - c.base(), 2 * c.half_width, c.depth});
    for (std::size_t i = 0; i < scene.species.size(); ++i)
        if (const double largest = scene.species[i].diameter.largest; clearly_more(largest, across))
            fail(scene, fmt::format("species[{}].diameter", i),
                 fmt::format(
                     "of {:.6g} m does not fit in the container, the mesh \"{}\", whose room is {:.6g} m "
                     "across; use smaller grains, or raise the mesh's 'scale'",
                     largest, excerpt(c.mesh), across));
}

void check_grain_sizes(const Scene& scene) {
    const Container& c = scene.container;
    if (c.shape == Container::Shape::none) return;
    struct Extent {
        double size;
        const char* key;
    };
    if (c.shape == Container::Shape::mesh) return check_grain_sizes_in_mesh(scene);
    std::vector<Extent> extents{{c.height, "height"}};
    const bool wedge = c.shape == Container::Shape::wedge;
    const bool cylinder = c.shape == Container::Shape::cylinder;
    extents.push_back({2 * c.half_width, cylinder ? "diameter" : wedge ? "half_width" : "width"});
    if (!cylinder) extents.push_back({c.depth, "depth"});
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        const double largest = scene.species[i].diameter.largest;
        for (const Extent& extent : extents)
            if (clearly_more(largest, extent.size))
                fail(scene, fmt::format("species[{}].diameter", i),
                     fmt::format("of {:.6g} m does not fit in the container, {:.6g} m across (container.{}); "
                                 "use smaller "
                                 "grains or a larger container",
                                 largest, extent.size, extent.key));
        if (c.periodic_depth && clearly_less(c.depth, shortest_period * largest))
            fail(scene, "container.depth",
                 fmt::format(
                     "of {:.6g} m is too short to be periodic, less than {} diameters of \"{}\", {:.6g} m; "
                     "lengthen it",
                     c.depth, shortest_period, scene.species[i].name, shortest_period * largest));
    }
}

// Volume (m3) of the grains that are there at the start.
double solid_at_start(const Scene& scene) {
    Scene start = scene;
    for (Species& species : start.species) species.fed = 0;
    return solid_volume(start);
}

void check_room(const Scene& scene) {
    if (!scene.start.packs()) return;
    const double solid = solid_at_start(scene);
    const double room = FreeSpace(scene).volume();
    if (room <= 0 && scene.start.region)
        fail(scene, "start.region",
             "has no room to pack grains in: it lies outside the container or behind a plane; move it");
    if (room <= 0 && scene.walls.empty())
        throw UserError("{}: the meshes leave no room in the container to start layers in; move them",
                        scene.where("mesh"));
    if (room <= 0)
        throw UserError(
            "{}: the planes leave no room in the container to start layers in; move "
            "them, or turn their normals towards the grains",
            scene.where("wall"));
    if (solid > most_solid * room)
        throw UserError(
            "{}: {} grains of {:.4g} m3 fill {:.1f} % of the {}'s {:.4g} m3, more than the "
            "{:.0f} % that can be packed; use fewer or smaller grains, or a larger container",
            scene.where("species"), scene.grains_at_start(), solid, 100 * solid / room,
            scene.start.region                                                       ? "region"
            : scene.walls.empty() && scene.meshes.size() == (scene.vessel() ? 1 : 0) ? "container"
                                                                                     : "room",
            room, 100 * most_solid);
}

// The grains of all feeds must find room, unless the scene has exits.
void check_feeds(const Scene& scene) {
    if (scene.feeds.empty() || scene.container.shape == Container::Shape::none || !scene.exits.empty())
        return;
    Scene whole = scene;
    whole.start.region.reset();
    const double solid = solid_volume(scene), room = FreeSpace(whole).volume();
    if (solid > closest_packing * room)
        throw UserError(
            "{}: with what is fed, {} grains fill {:.1f} % of the container's {:.4g} m3, more than the "
            "{:.0f} % of a random close packing; feed fewer, end earlier, or take a larger container",
            scene.where("feed"), scene.grains(), 100 * solid / room, room, 100 * closest_packing);
}

// Layers need something to lie on.
void check_gravity(const Scene& scene) {
    const bool held = scene.container.lid || !scene.walls.empty() || !scene.meshes.empty();
    if (scene.start.method != Start::Method::layers || held || scene.gravity.z() <= 0) return;
    fail(scene, "gravity",
         fmt::format(
             "points up, with {0:.6g} m/s2 along z, and the container is open above, so that the grains "
             "fall out of it; write gravity = {0:.6g}, which is downwards, or top = \"lid\"",
             scene.gravity.z()));
}

void check_drive(const Scene& scene) {
    const Drive& drive = scene.drive;
    if (!drive.present) return;
    check_stages(scene);
    if (drive.moves == Drive::Moves::container) return;
    const double stroke = 2 * drive.largest_amplitude() * std::abs(drive.direction.z());
    if (!clearly_less(stroke, scene.container.height))
        fail(scene, "drive.moves",
             fmt::format(
                 "is \"floor\", whose stroke of {:.6g} m is not less than the container's height, {:.6g} m; "
                 "reduce the amplitude",
                 stroke, scene.container.height));
}

}  // namespace

void check_scene(const Scene& scene) {
    check_names(scene);
    check_wedge(scene);
    check_meshes(scene);
    check_grain_sizes(scene);
    check_room(scene);
    check_feeds(scene);
    check_gravity(scene);
    check_drive(scene);
    check_outlet(scene);
    check_tray(scene);
    check_wall_grains(scene);
}

// The same for values about meshes, exits and turning containers.

namespace {

using Shape = Container::Shape;

// Names of the faces that containers and trays can have. A mesh of such a name would share their columns.
constexpr std::array<std::string_view, 10> kFaces{
    "wall", "floor", "lid", "left wall", "right wall", "left slant", "right slant", "back", "front", "tray"};

std::string key_of(std::size_t mesh, const char* name) {
    return fmt::format("mesh[{}].{}", mesh, name);
}

// What else has the name of this mesh; empty when nothing has.
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
    for (const ScenePlane& wall : scene.walls)
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

// Refuses what cannot go together with meshes.
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
    const double off = math::hypot(c.turn->axis.x(), c.turn->axis.y());
    const double beside = math::hypot(c.turn->through.x(), c.turn->through.y());
    if (off > kSameDecimals || beside > kSameDecimals * c.half_width)
        fail(scene, off > kSameDecimals ? "container.turn.axis" : "container.turn.through",
             "must be the cylinder's own axis, z through its middle; lay a drum on its side by the direction "
             "of "
             "gravity, as in gravity = [0, -9.81, 0], or take a [[mesh]]");
}

// If the scene has no exits, its vessel must have no hole through which grains could leave.
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
    check_walls(scene);
    check_turn(scene);
    check_paths(scene);
    check_vessel(scene);
}

std::vector<std::string> doubts_of_meshes(const Scene& scene) {
    constexpr double too_large = 3000,
                     too_small = 0.5;  // in diameters of the largest and of the smallest grain
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
