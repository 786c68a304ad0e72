// What a scene places by hand: [[grain]] and [[wall]].
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/utf8.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/text/reader_parts.hpp"

namespace grainreel {
namespace {

constexpr double same_size = 1e-6;  // relative: a diameter written by hand is not exact to the last bit

Vec3 required_vector(Document& document, const std::string& path) {
    const auto value = document.vector(path);
    if (!value) document.fail_missing(path);
    return *value;
}

std::size_t species_of(Document& document, const Scene& scene, const std::string& path) {
    const auto name = document.text(path);
    if (!name) return 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].name == *name) return s;
    document.fail(path,
                  fmt::format("names \"{}\", which is no species; name one of [[species]]", excerpt(*name)));
}

ListedGrain read_grain(Document& document, const Scene& scene, const std::string& table) {
    ListedGrain grain;
    grain.species = species_of(document, scene, table + ".species");
    const SizeSpread& spread = scene.species[grain.species].diameter;
    grain.diameter = document.quantity(table + ".diameter").value_or(spread.mean);
    if (grain.diameter < spread.smallest * (1 - same_size) ||
        grain.diameter > spread.largest * (1 + same_size))
        document.fail(table + ".diameter",
                      fmt::format("of {:.6g} m is outside its species' {:.6g} to {:.6g} m; widen the spread",
                                  grain.diameter, spread.smallest, spread.largest));
    grain.position = required_vector(document, table + ".position");
    grain.velocity = document.vector(table + ".velocity").value_or(grain.velocity);
    grain.spin = document.vector(table + ".spin").value_or(grain.spin);
    return grain;
}

FreeWall read_wall(Document& document, const std::string& table, std::size_t number) {
    FreeWall wall;
    wall.name = document.text(table + ".name").value_or(fmt::format("wall {}", number + 1));
    wall.point = required_vector(document, table + ".point");
    const Vec3 normal = required_vector(document, table + ".normal");
    const double length = normal.norm();
    if (length == 0) document.fail(table + ".normal", "must not be zero; write for example [0, 0, 1]");
    // A unit vector keeps its bits, so that a resolved scene reads back as it was.
    wall.normal = std::abs(length - 1) < 1e-15 ? normal : Vec3(normal / length);
    wall.velocity = document.vector(table + ".velocity").value_or(wall.velocity);
    wall.moves = document.flag(table + ".moves").value_or(wall.moves);
    if (wall.moves && !document.has("drive"))
        document.fail(table + ".moves", "follows a drive, but there is none; add [drive] or remove it");
    return wall;
}

}  // namespace

void read_exact(Document& document, Scene& scene) {
    for (std::size_t i = 0; i < document.size("wall"); ++i)
        scene.walls.push_back(read_wall(document, fmt::format("wall[{}]", i), i));
    const std::size_t listed = document.size("grain");
    if (listed == 0) return;
    for (Species& species : scene.species) species.count = 0;
    for (std::size_t i = 0; i < listed; ++i) {
        scene.start.grains.push_back(read_grain(document, scene, fmt::format("grain[{}]", i)));
        ++scene.species[scene.start.grains.back().species].count;
    }
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].count == 0)
            document.fail(fmt::format("species[{}].name", s),
                          fmt::format("\"{}\" has no grain among those listed; add one or remove the species",
                                      excerpt(scene.species[s].name)));
}

// Empty space has the size of what happens in it.
void size_empty_space(Scene& scene) {
    Container& c = scene.container;
    if (c.shape != Container::Shape::none) return;
    const Extent extent = extent_of(scene);
    c.depth = extent.size().x();
    c.half_width = 0.5 * extent.size().y();
    c.height = extent.size().z();
    c.lid = false;
}

}  // namespace grainreel
