// The keys of [film.walls]: how meshes are drawn.
#include <algorithm>

#include <fmt/format.h>

#include "engine/base/utf8.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;

// Throws UserError for a name that no mesh has.
std::vector<std::string> mesh_names(Document& document, const Scene& scene, const std::string& path) {
    std::vector<std::string> names = document.name_list(path);
    std::string known;
    for (const SceneMesh& mesh : scene.meshes)
        known += (known.empty() ? "\"" : ", \"") + excerpt(mesh.name) + "\"";
    for (const std::string& name : names)
        if (std::none_of(scene.meshes.begin(), scene.meshes.end(),
                         [&](const SceneMesh& mesh) { return mesh.name == name; }))
            document.fail(path, fmt::format("names the mesh \"{}\", which is not there; there is {}",
                                            excerpt(name), known.empty() ? "none" : known));
    return names;
}

BoundKey<FilmWalls> names_key(const char* name, std::vector<std::string> FilmWalls::*member,
                              const char* about) {
    return bound_by<FilmWalls>(
        entry(name, KeyKind::name_list, note("by their shape"), about),
        [member](Document& document, const Scene& scene, const std::string& path, FilmWalls& into) {
            if (document.has(path)) into.*member = mesh_names(document, scene, path);
        },
        [member](const FilmWalls& from, const Scene&) {
            std::vector<std::string> words;
            for (const std::string& word : from.*member) words.push_back(quoted(word));
            return words.empty() ? "" : toml_list(words);
        });
}

const KeyTable<FilmWalls>& walls_table() {
    using Colour = FilmWalls::Colour;
    static const KeyTable<FilmWalls> table{
        choice(
            "colour", &FilmWalls::colour,
            Words<Colour>{{"plain", Colour::plain}, {"pressure", Colour::pressure}, {"wear", Colour::wear}},
            initial(),
            "Colours of meshes: plain, or by what the grains do to each triangle (instrument wear): the mean "
            "normal force over its area, or the work of the tangential forces over its area.")
            .unwritten_if([](const FilmWalls& walls) { return walls.colour == Colour::plain; }),
        quantity("edge_angle", &FilmWalls::edge_angle, Dimension::degrees, {0, 180, false, false}, initial(),
                 "Edges of a mesh whose faces turn more than this are drawn, beside its outlines.")
            .unwritten_if([](const FilmWalls& walls) { return walls == FilmWalls(); }),
        names_key("solid", &FilmWalls::solid, "Meshes that hide what is behind them from all sides."),
        names_key("glass", &FilmWalls::glass, "Meshes that are glass from outside and solid from within."),
    };
    return table;
}

}  // namespace

void list_film_walls(Keys& all) {
    walls_table().list(all, "film.walls");
}

void read_film_walls(Document& document, FilmedScene& scene) {
    FilmWalls& walls = scene.film.look.walls;
    walls_table().read(document, scene, "film.walls", walls);
    if (walls.colour != FilmWalls::Colour::plain && scene.meshes.empty())
        document.fail("film.walls.colour", "colours meshes, and the scene has none; leave it out");
    for (const std::string& name : walls.solid)
        if (std::find(walls.glass.begin(), walls.glass.end(), name) != walls.glass.end())
            document.fail("film.walls.glass",
                          fmt::format("names \"{}\", which 'solid' names too; take one out", excerpt(name)));
}

void write_film_walls(SceneText& out, const FilmedScene& scene) {
    if (scene.film.look.walls == FilmWalls()) return;
    out.table("film.walls");
    walls_table().write(out, scene, scene.film.look.walls);
}

}  // namespace grainreel
