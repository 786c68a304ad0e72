// The keys of style and light, which are part of [film], and the keys of [film.cut] and [film.walls].

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/lists.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/film.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

using namespace keys;

BoundKey<FilmLook> style_key() {
    BoundKey<FilmLook> style =
        choice("style", &FilmLook::style, style_words, initial(),
               "Of the light: soft shadows; even colours with outlines, for print; for dark "
               "rooms.");
    return style.read_at(-1);
}

// The key of a kind of light, whose default comes from the style. The key is written only where the scene
// gives it, so that a written scene can be given another style.
BoundKey<FilmLook> light(const char* name, bool FilmLook::*member, const char* about) {
    return flag(name, member, note("true; false with flat"), about)
        .usually([member](FilmLook& look, const Scene&) { look.*member = FilmLook::of(look.style).*member; })
        .unwritten_if(
            [member](const FilmLook& look) { return look.*member == FilmLook::of(look.style).*member; });
}

const KeyTable<FilmLook>& look_table() {
    static const KeyTable<FilmLook> table{
        style_key(),
        light(
            "occlusion", &FilmLook::occlusion,
            "Less light reaches the gaps between grains, their feet on walls, and corners where walls meet."),
        light("shadows", &FilmLook::shadows, "Of grains on other grains and on walls."),
        light("ground", &FilmLook::ground,
              "Under the container or the meshes, with their shadow, and the backdrop behind it."),
        flag("rotation", &FilmLook::rotation, initial(),
             "Grains are light on one half and dark on the other and so show how they turn."),
    };
    return table;
}

const KeyTable<FilmCut>& cut_table() {
    static const KeyTable<FilmCut> table{
        vector("normal", &FilmCut::normal, Dimension::number, note("[1, 0, 0]"),
               "Opens the bed along a plane: what lies on this side of it is taken away."),
        quantity("at", &FilmCut::at, Dimension::length, any, note("0"),
                 "Distance of that plane from the origin, along the normal."),
        quantity("thickness", &FilmCut::thickness, Dimension::length, positive, note("all behind it"),
                 "Of the slab behind the plane that is kept.")
            .unwritten_if([](const FilmCut& cut) { return cut.thickness == 0; }),
    };
    return table;
}

}  // namespace

void list_look(Keys& all) {
    look_table().list(all, "film");
}

void list_cut(Keys& all) {
    cut_table().list(all, "film.cut");
}

void read_look(Document& document, FilmedScene& scene) {
    look_table().read(document, scene, "film", scene.film.look);
    FilmCut& cut = scene.film.look.cut;
    cut.present = document.has("film.cut");
    if (!cut.present) return;
    cut_table().read(document, scene, "film.cut", cut);
    if (cut.normal.norm() < 1e-9)
        document.fail("film.cut.normal", "has no direction; write for example [1, 0, 0]");
    if (document.has("film.cut.normal")) cut.normal.normalize();
}

void write_look(SceneText& out, const FilmedScene& scene) {
    look_table().write(out, scene, scene.film.look);
}

void write_cut(SceneText& out, const FilmedScene& scene) {
    if (!scene.film.look.cut.present) return;
    out.table("film.cut");
    cut_table().write(out, scene, scene.film.look.cut);
}

namespace {

// The names in the list at `path`. Throws UserError for a name that no mesh has.
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

// `true`, or the names of meshes.
BoundKey<FilmWalls> glass_key() {
    return bound_by<FilmWalls>(
        entry("glass", KeyKind::names_or_all, note("by their shape"),
              "Meshes that are glass from outside and solid from within; or true: all walls, those of the "
              "container too, are glass from both sides."),
        [](Document& document, const Scene& scene, const std::string& path, FilmWalls& into) {
            if (!document.has(path)) return;
            if (document.is_array(path))
                into.glass = mesh_names(document, scene, path);
            else
                into.clear = document.flag(path).value_or(false);
        },
        [](const FilmWalls& from, const Scene&) {
            if (from.clear) return std::string("true");
            std::vector<std::string> words;
            for (const std::string& word : from.glass) words.push_back(quoted(word));
            return words.empty() ? "" : toml_list(words);
        });
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

// The range is read after the colour, and only where walls are not plain.
void read_range(Document& document, const Scene& scene, const std::string& path, FilmWalls& walls) {
    const std::string key = "film.walls.colour";
    if (scene.meshes.empty()) document.fail(key, "colours meshes, and the scene has none; leave it out");
    const auto range = document.interval(path, dimension_of(walls.colour));
    walls.fixed = range.has_value();
    walls.range = range.value_or(usual_range(walls.colour, scene));
    if (walls.fixed && !(walls.range[0] >= 0 && walls.range[0] < walls.range[1]))
        document.fail(path, "must rise from 0 or more, from low to high; exchange them or widen it");
    if (!walls.fixed && !(walls.range[1] > 0 && std::isfinite(walls.range[1])))
        document.fail(key,
                      fmt::format("is \"{}\", for which this scene gives no scale; write a 'range' for it",
                                  word_of(walls.colour, wall_colour_words)));
}

std::string range_text(const FilmWalls& walls, const Scene&) {
    return walls.fixed ? toml_list({as_toml(walls.range[0]), as_toml(walls.range[1])}) : "";
}

// The colours of walls change with every record of fields.nc. If the scene neither keeps fields nor says how
// long records are, they are made as short as a film needs them.
void shorten_records(const Document& document, double duration, FieldOutput& fields) {
    constexpr double records = 100;
    if (fields.wanted()) return;
    if (fields.interval > 0 && !document.has("output.fields.interval")) fields.interval = duration / records;
    if (fields.periods > 0 && !document.has("output.fields.periods")) fields.periods = 1;
}

const char* of_plain_walls(const FilmWalls& walls) {
    return walls.coloured() ? nullptr : "walls are plain; give them a 'colour'";
}

const KeyTable<FilmWalls>& walls_table() {
    static const KeyTable<FilmWalls> table{
        choice(
            "colour", &FilmWalls::colour, wall_colour_words, initial(),
            "Colours of meshes: plain, or by what the grains do to each triangle: the mean normal force "
            "divided by its area, or the work of rubbing divided by its area (instrument wear). The colours"
            " are those of the last record of fields.nc. A record is a hundredth of the run or a period of "
            "the drive unless the scene says otherwise.")
            .owns({"range"})
            .unwritten_if([](const FilmWalls& walls) { return !walls.coloured(); }),
        bound_by<FilmWalls>(
            entry("range", KeyKind::interval, note("three powers of ten, from bed and motion"),
                  "The ends of the colours for the whole film, [\"10 Pa\", \"10 kPa\"] or [\"1 J/m2\", \"1 "
                  "kJ/m2\"]. Colours go by powers of ten, or, if the range begins at 0, evenly."),
            read_range, range_text)
            .useless_for(of_plain_walls),
        quantity("edge_angle", &FilmWalls::edge_angle, Dimension::degrees, {0, 180, false, false}, initial(),
                 "Edges of a mesh whose faces turn more than this are drawn, beside its outlines.")
            .unwritten_if([](const FilmWalls& walls) { return walls == FilmWalls(); }),
        names_key("solid", &FilmWalls::solid, "Meshes that hide what is behind them from all sides."),
        glass_key(),
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
    if (walls.coloured()) shorten_records(document, scene.run.duration, scene.output.fields);
    for (const std::string& name : walls.solid)
        if (contains(walls.glass, name))
            document.fail("film.walls.glass",
                          fmt::format("names \"{}\", which 'solid' names too; take one out", excerpt(name)));
}

void write_film_walls(SceneText& out, const FilmedScene& scene) {
    if (scene.film.look.walls == FilmWalls()) return;
    out.table("film.walls");
    walls_table().write(out, scene, scene.film.look.walls);
}

}  // namespace grainreel
