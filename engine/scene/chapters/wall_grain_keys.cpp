// The key of grains that are glued to walls (container.wall_grains), and its checks.
#include "engine/base/mathematics.hpp"
#include "engine/scene/chapters/container_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {
namespace {

using namespace keys;
using W = WallGrains;
using Shape = Container::Shape;

constexpr double most_glued = 1e6;

// Replaces characters: a scene writes names of faces with "_" where the face's own name has blanks.
std::string with(std::string name, char from, char to) {
    std::replace(name.begin(), name.end(), from, to);
    return name;
}

std::vector<std::string> faces_of(const Container& c) {
    if (c.shape == Shape::none) return {};
    std::vector<std::string> faces{"floor"};
    if (c.lid) faces.push_back("lid");
    if (c.shape == Shape::cylinder) {
        faces.push_back("wall");
        return faces;
    }
    for (const char* side : {"left wall", "right wall"}) faces.push_back(side);
    if (c.shape == Shape::wedge)
        for (const char* side : {"left slant", "right slant"}) faces.push_back(side);
    if (!c.periodic_depth)
        for (const char* side : {"back", "front"}) faces.push_back(side);
    return faces;
}

std::vector<std::string> written(const std::vector<std::string>& faces) {
    std::vector<std::string> words;
    for (const std::string& face : faces) words.push_back(with(face, ' ', '_'));
    return words;
}

BoundKey<W> species_key() {
    return bound_by<W>(
        entry("species", KeyKind::text, note("the first"),
              "Of the glued grains, which do not count as grains. A species may be there for them alone."),
        [](Document& document, const Scene& scene, const std::string& path, W& layer) {
            layer.species = species_named(document, scene, path);
        },
        [](const W& layer, const Scene& scene) { return quoted(scene.species[layer.species].name); });
}

BoundKey<W> faces_key() {
    const auto read = [](Document& document, const Scene&, const std::string& path, W& layer) {
        for (const std::string& face : document.name_list(path)) layer.faces.push_back(with(face, '_', ' '));
        if (layer.faces.empty()) document.fail(path, "names no face; write for example [\"floor\"]");
    };
    return bound_by<W>(
        entry("faces", KeyKind::name_list, required(),
              "Which faces: \"floor\", \"lid\", \"left_wall\", \"right_wall\", \"left_slant\", "
              "\"right_slant\", \"back\", \"front\", \"wall\" of a cylinder."),
        read, [](const W& layer, const Scene&) { return names_text(written(layer.faces)); });
}

const KeyTable<W>& layer_table() {
    static const KeyTable<W> table{
        species_key(),
        faces_key(),
        quantity("spacing", &W::spacing, Dimension::length, positive, note("the species' mean diameter"),
                 "Between neighbours in the layer.")
            .usually([](W& layer, const Scene& scene) {
                layer.spacing = scene.species[layer.species].diameter.mean;
            }),
        quantity("disorder", &W::disorder, Dimension::number, Range{0, 0.5, false, false}, initial(),
                 "How far at most each is moved at random in its face, divided by the spacing; 0 leaves a "
                 "triangular lattice."),
    };
    return table;
}

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError("{}: '{}' {}", scene.where("container.wall_grains." + key), key, what);
}

void read_layer(Document& document, const Scene& scene, const std::string& path, Container& container) {
    if (!document.has(path)) return;
    if (!document.is_table(path)) {
        if (document.text(path) != "none")
            document.fail(
                path, fmt::format("is {}; write {{ species = \"big\", faces = [\"floor\"] }}, or \"none\"",
                                  document.written_value(path)));
        return;
    }
    W layer;
    layer_table().read(document, scene, path, layer);
    container.wall_grains = layer;
}

void check_faces(const Scene& scene) {
    const std::vector<std::string> there = faces_of(scene.container);
    std::vector<std::string> taken;
    for (const std::string& face : scene.container.wall_grains->faces) {
        if (!contains(there, face))
            fail(scene, "faces",
                 fmt::format("names \"{}\", which is no face of this container; there is {}",
                             excerpt(with(face, ' ', '_')), fmt::join(written(there), ", ")));
        if (contains(taken, face))
            fail(scene, "faces", fmt::format("names \"{}\" twice; take one out", with(face, ' ', '_')));
        taken.push_back(face);
    }
}

// An upper bound (m2) of the area of any face.
double largest_face(const Container& c) {
    const double slope = c.shape == Shape::wedge ? c.slant_height / math::cos(c.half_angle) : 0;
    const double high = std::max({c.height, slope, 2 * c.half_width});
    const double around = c.shape == Shape::cylinder ? 2 * std::numbers::pi * c.half_width : c.depth;
    return high * std::max(around, 2 * c.half_width);
}

void check_number(const Scene& scene) {
    const W& layer = *scene.container.wall_grains;
    const double of_each = layer.spacing * layer.spacing * std::sqrt(3.0) / 2;
    const double most = static_cast<double>(layer.faces.size()) * largest_face(scene.container) / of_each;
    if (most > most_glued)
        fail(scene, "spacing",
             fmt::format("of {:.6g} m makes up to {:.2g} glued grains, more than {:.0e}; widen it",
                         layer.spacing, most, most_glued));
}

// Diameter (m) of the largest free grain.
double largest_free(const Scene& scene) {
    double largest = 0;
    for (const Species& species : scene.species)
        if (species.all() > 0) largest = std::max(largest, species.diameter.largest);
    return largest;
}

// The space between two sides of a container.
struct Room {
    const char* key;  // gives its width
    double size;      // m
    std::vector<std::string> one_side, other_side;
};

std::vector<Room> rooms_of(const Container& c) {
    std::vector<Room> rooms{{"height", c.height, {"floor"}, {"lid"}}};
    if (c.shape == Shape::cylinder) {
        rooms.push_back({"diameter", 2 * c.half_width, {"wall"}, {"wall"}});
        return rooms;
    }
    rooms.push_back({c.shape == Shape::wedge ? "half_width" : "width",
                     2 * c.half_width,
                     {"left wall", "left slant"},
                     {"right wall", "right slant"}});
    rooms.push_back({"depth", c.depth, {"back"}, {"front"}});
    return rooms;
}

// A glued grain stands out by its radius. Between two sides the largest free grain must have room.
void check_room(const Scene& scene) {
    const W& layer = *scene.container.wall_grains;
    const double largest = scene.species[layer.species].diameter.largest, free = largest_free(scene);
    const auto taken_at = [&](const std::vector<std::string>& side) {
        const bool rough = std::any_of(side.begin(), side.end(),
                                       [&](const std::string& face) { return contains(layer.faces, face); });
        return rough ? 0.5 * largest : 0;
    };
    for (const Room& room : rooms_of(scene.container)) {
        const double left = room.size - taken_at(room.one_side) - taken_at(room.other_side);
        if (!clearly_less(largest, room.size))
            fail(scene, "species",
                 fmt::format(
                     "glues grains of up to {:.6g} m, larger than the room: container.{} leaves {:.6g} "
                     "m; use smaller ones, or a larger container",
                     largest, room.key, room.size));
        if (left < free - kSameDecimals * room.size)
            fail(
                scene, "species",
                fmt::format("glues grains of up to {:.6g} m, larger than the room: they leave {:.6g} m along "
                            "container.{}, less than the largest grain, {:.6g} m; use smaller ones, or a "
                            "larger container",
                            largest, std::max(0.0, left), room.key, free));
    }
}

}  // namespace

BoundKey<Container> wall_grains_key() {
    const auto write = [](const Container& container, const Scene& scene) {
        return container.wall_grains ? layer_table().inline_text(scene, *container.wall_grains)
                                     : std::string();
    };
    return bound_by<Container>(entry("wall_grains", KeyKind::text, literal("\"none\""),
                                     "Or a table: a layer of grains glued to faces, which makes these rough. "
                                     "Their centres lie in the face."),
                               read_layer, write)
        .holding(layer_table());
}

void check_wall_grains(const Scene& scene) {
    if (!scene.container.wall_grains) return;
    check_faces(scene);
    check_room(scene);
    check_number(scene);
}

bool is_glued(Document& document, std::size_t number, const std::string& name) {
    const std::string path = "container.wall_grains";
    if (!document.is_table(path)) return false;
    const auto species = document.text(path + ".species");
    return species ? *species == name : number == 0;
}

}  // namespace grainreel
