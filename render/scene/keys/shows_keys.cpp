// The keys of what the film hides, rings and writes beside the grains: part of [film].
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/keys/named_grains.hpp"
#include "render/scene/live_text.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

using namespace keys;

// "speed > 20 cm/s": a quantity that can colour grains, < or >, a value of it.
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
    const std::size_t at = text->find_first_not_of(' ', sign + 1);
    const std::string value = at == std::string::npos ? "" : text->substr(at);
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
    try {
        shows.live_words = parse_live_text(shows.text, scene.measurable.columns);
    } catch (const UserError& error) {
        document.fail(path, error.what());
    }
}

// The weight of all grains, or what the floor presses them up with at the drive's strongest, if that is more.
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
    shows.outflow = leave;  // an exit may be there for strays alone
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
                             "Of an arrow a quarter as long as the container is wide."),
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
        if (std::find(shows.hidden.begin(), shows.hidden.end(), ghost) != shows.hidden.end())
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

}  // namespace grainreel
