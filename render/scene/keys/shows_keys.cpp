// The keys of [film.colour], which say what the colour of a grain stands for, and the keys of [film] that
// hide and ring grains, draw forces and write words beside the grains.

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/live_text.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

using namespace keys;
using C = GrainColouring;

const char* by_species(const C& colour) {
    return colour.by == GrainValue::species ? "the grains are coloured by species" : nullptr;
}

const char* of_pure_numbers(const C& colour) {
    if (const char* reason = by_species(colour)) return reason;
    return dimension_of(colour.by) == Dimension::number ? "it is a pure number" : nullptr;
}

const char* without_bands(const C& colour) {
    return colour.by != GrainValue::start_height ? "only 'by = \"start-height\"' makes bands" : nullptr;
}

void check_range(const Document& document, const std::string& path, const C& colour) {
    const auto [low, high] = colour.range;
    if (low < high) return;
    if (document.has(path)) document.fail(path, "must rise, from low to high; exchange them or widen it");
    document.fail("film.colour.by",
                  fmt::format("is \"{}\", for which this scene gives no scale; write a 'range' for it",
                              word_of(colour.by, grain_value_words)));
}

void check_drive(const Document& document, const Scene& scene, const C& colour) {
    const bool by_periods = colour.by == GrainValue::displacement || colour.by == GrainValue::rise;
    if (by_periods && !scene.drive.present)
        document.fail("film.colour.by",
                      "counts from one period of the drive to the next, but nothing "
                      "oscillates; add [drive] or write \"speed\"");
}

void read_scale(Document& document, const Scene&, const std::string& path, C& colour) {
    const std::string word = document.text(path).value_or("linear");
    if (word != "linear" && word != "logarithmic")
        document.fail(path, fmt::format("is \"{}\"; write \"linear\" or \"logarithmic\"", word));
    colour.logarithmic = word == "logarithmic";
}

// The usual range begins at 0, which has no logarithm, so a logarithmic scale spans three powers of ten below
// the upper end.
void make_logarithmic(const Document& document, C& colour) {
    constexpr double powers = 1e-3;
    if (is_signed(colour.by))
        document.fail("film.colour.scale",
                      fmt::format("is \"logarithmic\", but \"{}\" has two signs; write \"linear\"",
                                  word_of(colour.by, grain_value_words)));
    if (!colour.fixed && colour.range[0] <= 0) colour.range[0] = powers * colour.range[1];
    if (colour.range[0] <= 0)
        document.fail("film.colour.range", "must begin above 0, because the scale is logarithmic");
}

void read_range(Document& document, const Scene& scene, const std::string& path, C& colour) {
    check_drive(document, scene, colour);
    const auto range = document.interval(path, dimension_of(colour.by));
    colour.fixed = range.has_value();
    colour.range = range.value_or(usual_range(colour.by, scene));
    if (colour.logarithmic) make_logarithmic(document, colour);
    check_range(document, path, colour);
}

// Only a range that the user gave is written. Otherwise the quantity decides the range, also when a finished
// run is drawn again in other colours.
std::string range_text(const C& colour, const Scene&) {
    return colour.fixed ? toml_list({as_toml(colour.range[0]), as_toml(colour.range[1])}) : "";
}

void read_unit(Document& document, const Scene&, const std::string& path, C& colour) {
    const auto unit = document.text(path);
    const Dimension dimension = dimension_of(colour.by);
    try {
        if (unit) unit_size(*unit, dimension);
    } catch (const UserError& error) {
        document.fail(path, error.what());
    }
    colour.unit = unit.value_or(fitting_unit(std::max(-colour.range[0], colour.range[1]), dimension));
}

BoundKey<C> coloured_species_key() {
    BoundKey<C> species = species_key("species", &C::species,
                                      "Species that are coloured so; the others keep their own colours.");
    species.key.fallback_note = "all";
    return species.useless_for([](const C& colour) {
        if (const char* reason = by_species(colour)) return reason;
        return colour.as_field ? "a field is the mean of all grains" : nullptr;
    });
}

const KeyTable<C>& colour_table() {
    static const KeyTable<C> table{
        choice("by", &C::by, grain_value_words, initial(),
               "What a grain's colour stands for; see docs/guide/colours.md.")
            .owns({"map", "unit", "range", "layers", "as", "scale", "species"}),
        bound_by<C>(
            entry("scale", KeyKind::text, literal("\"linear\""),
                  "linear or logarithmic: equal ratios have equal distances on the colour bar."),
            read_scale,
            [](const C& colour, const Scene&) { return colour.logarithmic ? quoted("logarithmic") : ""; })
            .useless_for(by_species),
        choice("map", &C::map, colour_map_words, note("viridis; vik for what has two signs"),
               "All three are safe for the colour-blind; vik runs from blue over white to red.")
            .useless_for(by_species)
            .usually([](C& colour, const Scene&) {
                if (is_signed(colour.by)) colour.map = ColourMap::vik;
            }),
        bound_by<C>(entry("range", KeyKind::interval, note("from the drive and the bed"),
                          "The ends of the map for the whole film, in units of the quantity, [\"0 m/s\", "
                          "\"0.5 m/s\"]."),
                    read_range, range_text)
            .useless_for(by_species),
        bound_by<C>(
            entry("unit", KeyKind::text, note("one that fits the range"),
                  "Of the colour bar, for example \"cm/s\"."),
            read_unit,
            [](const C& colour, const Scene&) { return colour.unit.empty() ? "" : quoted(colour.unit); })
            .useless_for(of_pure_numbers),
        choice("as", &C::as_field, ChoiceWords<bool>{{"grains", false}, {"field", true}}, initial(),
               "field: the grains' mean over the depth, by coarse-graining, as a layer before pale grains.")
            .useless_for(by_species),
        integer("layers", &C::layers, 2, 12, initial(), "Bands of start-height.").useless_for(without_bands),
        coloured_species_key(),
    };
    return table;
}

}  // namespace

void list_colour(Keys& all) {
    colour_table().list(all, "film.colour");
}

void read_colour(Document& document, FilmedScene& scene) {
    colour_table().read(document, scene, "film.colour", scene.film.shows.colour);
}

void write_colour(SceneText& out, const FilmedScene& scene) {
    out.table("film.colour");
    colour_table().write(out, scene, scene.film.shows.colour);
}

namespace {

// Reads "speed > 20 cm/s": a quantity that can colour grains, < or >, and a value of it.
void read_condition(Document& document, const Scene& scene, const std::string& path, FilmShows& shows) {
    GrainCondition& condition = shows.highlight_if;
    const auto text = document.text(path);
    if (!text || text->empty()) return;
    const std::size_t sign = text->find_first_of("<>");
    const std::string name = text->substr(0, text->find_last_not_of(' ', sign == 0 ? 0 : sign - 1) + 1);
    const auto known = std::find_if(grain_value_words.begin() + 1, grain_value_words.end(),
                                    [&](const auto& word) { return word.first == name; });
    if (sign == std::string::npos || known == grain_value_words.end())
        document.fail(path,
                      fmt::format("must be a quantity of film.colour.by, < or >, and a value, but is {}; "
                                  "write for example \"speed > 20 cm/s\"",
                                  document.written_value(path)));
    condition = {known->second, (*text)[sign] == '>', 0, *text};
    const std::size_t begin = text->find_first_not_of(' ', sign + 1);
    const std::string value = begin == std::string::npos ? "" : text->substr(begin);
    const Dimension dimension = dimension_of(condition.of);
    if (dimension == Dimension::number) {
        const char* const end = value.data() + value.size();
        const auto read = std::from_chars(value.data(), end, condition.limit);
        if (read.ec != std::errc() || read.ptr != end)
            document.fail(path,
                          fmt::format("wants a plain number after its sign, but has \"{}\"", excerpt(value)));
        return;
    }
    try {
        condition.limit = parse_quantity(value, dimension);
    } catch (const UserError& error) {
        document.fail(path, error.what());
    }
    if (!scene.drive.present &&
        (condition.of == GrainValue::displacement || condition.of == GrainValue::rise))
        document.fail(path, "counts from one period of the drive to the next, but nothing oscillates");
}

void read_words(Document& document, const Scene& scene, const std::string& path, FilmShows& shows) {
    shows.text = document.text(path).value_or("");
    shows.live_words = parts_of_text(document, scene, path, shows.text);
}

// N: the weight of all grains, or, if that is more, the force with which the floor lifts them when the drive
// is strongest.
double usual_wall_force(const Scene& scene) {
    const double gravity = scene.gravity.norm(), weight = total_mass(scene) * gravity;
    return scene.drive.present ? weight * std::max(1.0, scene.drive.strongest_g_level(gravity)) : weight;
}

void read_wall_force_scale(Document& document, const Scene& scene, const std::string& path,
                           FilmShows& shows) {
    FilmWallForces& forces = shows.wall_forces;
    if (!forces.wanted) return document.refuse(path, "it belongs to wall_forces = true");
    forces.scale = usual_wall_force(scene);
    keys::read_value(document, path, forces.scale);
    if (!(forces.scale > 0) || !std::isfinite(forces.scale))
        document.fail(document.has(path) ? path : "film.wall_forces",
                      "needs a 'wall_force_scale': this scene gives no scale for forces");
}

void read_outflow(Document& document, const Scene& scene, const std::string& path, FilmShows& shows) {
    const bool leave = scene.container.outlet.has_value() && !scene.container.tray;
    shows.outflow = leave;  // not with exits alone, which may be there for strays
    keys::read_value(document, path, shows.outflow);
    const bool left_out = ends_early(document) && document.is_table("container.outlet");
    if (left_out && !scene.container.outlet) shows.outflow = false;
    if (shows.outflow && !leave && scene.exits.empty())
        document.fail(path,
                      scene.container.tray
                          ? "counts what leaves the run, but the tray catches it"
                          : "counts what flows out, but there is no [container.outlet] and no [[exit]]");
}

const KeyTable<FilmShows>& mark_table() {
    using S = FilmShows;
    static const KeyTable<S> table{
        species_key("hide", &S::hidden, "Species that are not drawn."),
        species_key("ghost", &S::ghosts, "Species that the others are seen through, as if of glass."),
        ids_key("highlight", &S::highlighted, "Ids of grains that are ringed."),
        bound_by<S>(
            entry("highlight_if", KeyKind::text, note("none"),
                  "Rings around grains of which this holds: \"speed > 20 cm/s\", \"coordination < 2\"."),
            read_condition,
            [](const S& shows, const Scene&) {
                return shows.highlight_if.wanted() ? quoted(shows.highlight_if.text) : "";
            }),
        flag("force_chains", &S::force_chains, initial(),
             "Lines between grains that touch, as wide as they push."),
        bound_by<S>(
            entry("wall_forces", KeyKind::flag, literal("false"),
                  "Arrows of the mean force on each wall since the row of measures before."),
            [](Document& document, const Scene&, const std::string& path, S& shows) {
                keys::read_value(document, path, shows.wall_forces.wanted);
            },
            [](const S& shows, const Scene&) { return as_toml(shows.wall_forces.wanted); })
            .owns({"wall_force_scale"}),
        bound_by<S>(quantity("wall_force_scale", Dimension::force, positive,
                             note("the weight of all grains, times the drive's strongest Γ above 1"),
                             "The force whose arrow is a quarter as long as the container is wide."),
                    read_wall_force_scale,
                    [](const S& shows, const Scene&) {
                        return shows.wall_forces.wanted ? as_toml(shows.wall_forces.scale, Dimension::force)
                                                        : "";
                    }),
        bound_by<S>(entry("outflow", KeyKind::flag, note("true with an outlet and no tray"),
                          "How many grains and how much mass have flowed out, on the frame."),
                    read_outflow,
                    [](const S& shows, const Scene& scene) {
                        return scene.container.outlet || shows.outflow ? as_toml(shows.outflow) : "";
                    }),
    };
    return table;
}

const KeyTable<FilmShows>& text_table() {
    static const KeyTable<FilmShows> table{
        bound_by<FilmShows>(
            entry("text", KeyKind::text, note("none"),
                  "Words beside the grains; {lacey} or {kinetic:mJ} are values of measures.csv."),
            read_words,
            [](const FilmShows& shows, const Scene&) {
                return shows.text.empty() ? "" : quoted(shows.text);
            }),
    };
    return table;
}

}  // namespace

void list_marks(Keys& all) {
    mark_table().list(all, "film");
}

void list_shows(Keys& all) {
    list_colour(all);
    text_table().list(all, "film");
    list_plots(all);
    list_arrows_and_trails(all);
}

void read_shows(Document& document, FilmedScene& scene) {
    FilmShows& shows = scene.film.shows;
    read_colour(document, scene);
    mark_table().read(document, scene, "film", shows);
    for (const std::size_t ghost : shows.ghosts)
        if (contains(shows.hidden, ghost))
            document.fail("film.ghost",
                          fmt::format("names \"{}\", which film.hide takes away; keep one of them",
                                      scene.species[ghost].name));
    text_table().read(document, scene, "film", shows);
    read_plots(document, scene);
    read_arrows_and_trails(document, scene);
}

void write_text(SceneText& out, const FilmedScene& scene) {
    text_table().write(out, scene, scene.film.shows);
}

void write_marks(SceneText& out, const FilmedScene& scene) {
    mark_table().write(out, scene, scene.film.shows);
}

void write_shows(SceneText& out, const FilmedScene& scene) {
    write_colour(out, scene);
    write_plots(out, scene);
    write_arrows_and_trails(out, scene);
}

std::vector<LiveWords> parts_of_text(const Document& document, const Scene& scene, const std::string& path,
                                     const std::string& text) {
    try {
        return parse_live_text(text, scene.measurable.columns, &scene);
    } catch (const UserError& error) {
        document.fail(path, error.what());
    }
}

// From here on: reading and writing lists of species by name and of grains by id.

namespace {

// The index of a species that is named at `path`.
std::size_t species_at(const Document& document, const Scene& scene, const std::string& path,
                       const std::string& name) {
    std::string known;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        if (scene.species[i].name == name) return i;
        known += (i > 0 ? ", \"" : "\"") + excerpt(scene.species[i].name) + "\"";
    }
    document.fail(
        path, fmt::format("names the species \"{}\", which is not there; there is {}", excerpt(name), known));
}

}  // namespace

std::vector<std::size_t> species_list(Document& document, const Scene& scene, const std::string& path) {
    std::vector<std::size_t> list;
    for (const std::string& name : document.name_list(path))
        list.push_back(species_at(document, scene, path, name));
    return list;
}

std::vector<std::int32_t> ids_at(Document& document, const Scene& scene, const std::string& path) {
    std::vector<std::int32_t> ids;
    for (const std::int64_t id : document.integer_list(path)) {
        if (id >= scene.grains())
            document.fail(path,
                          fmt::format("has the id {}, but ids run from 0 to {}", id, scene.grains() - 1));
        ids.push_back(static_cast<std::int32_t>(id));
    }
    return ids;
}

std::string species_text(const std::vector<std::size_t>& chosen, const Scene& scene) {
    std::vector<std::string> words;
    for (const std::size_t s : chosen) words.push_back(quoted(scene.species[s].name));
    return words.empty() ? "" : toml_list(words);
}

std::string ids_text(const std::vector<std::int32_t>& ids) {
    std::vector<std::string> words;
    for (const std::int32_t id : ids) words.push_back(std::to_string(id));
    return words.empty() ? "" : toml_list(words);
}

}  // namespace grainreel
