// Film: what colours and marks say.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/scene/film/grain_values.hpp"
#include "engine/scene/film/live_text.hpp"
#include "engine/scene/film/measure_columns.hpp"
#include "engine/scene/text/reader_parts.hpp"

namespace grainreel {
namespace {

constexpr double usual_trail_periods = 10;

// Index of a species that is named at `path`.
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

void check_range(const Document& document, const GrainColouring& colour) {
    const char* const path = "film.colour.range";
    const auto [low, high] = colour.range;
    if (low < high) return;
    if (document.has(path)) document.fail(path, "must rise, from low to high; exchange them or widen it");
    document.fail("film.colour.by",
                  fmt::format("is \"{}\", for which this scene gives no scale; write a 'range' for it",
                              word_of(colour.by, grain_value_words)));
}

void read_colour(Document& document, const Scene& scene, GrainColouring& colour) {
    colour.by = chosen(document, "film.colour.by", grain_value_words, colour.by);
    if (colour.by == GrainValue::species) {
        for (const char* key : {"map", "range", "unit"})
            document.refuse(fmt::format("film.colour.{}", key), "the grains are coloured by species");
    }
    if (colour.by != GrainValue::start_height)
        document.refuse("film.colour.layers", "only 'by = \"start-height\"' makes bands");
    if (colour.by == GrainValue::species) return;
    if (needs_displacement(scene.film.shows) && !scene.drive.present)
        document.fail("film.colour.by",
                      "counts from one period of the drive to the next, but nothing "
                      "oscillates; add [drive] or write \"speed\"");
    const Dimension dimension = dimension_of(colour.by);
    colour.map = chosen(document, "film.colour.map", colour_map_words,
                        is_signed(colour.by) ? ColourMap::vik : ColourMap::viridis);
    const auto range = document.interval("film.colour.range", dimension);
    colour.fixed = range.has_value();
    colour.range = range.value_or(usual_range(colour.by, scene));
    check_range(document, colour);
    colour.layers = static_cast<int>(document.integer("film.colour.layers").value_or(colour.layers));
    if (dimension == Dimension::number) document.refuse("film.colour.unit", "it is a pure number");
    const auto unit = document.text("film.colour.unit");
    try {
        if (unit) unit_size(*unit, dimension);
    } catch (const UserError& error) {
        document.fail("film.colour.unit", error.what());
    }
    colour.unit = unit.value_or(fitting_unit(std::max(-colour.range[0], colour.range[1]), dimension));
}

constexpr std::size_t most_plots = 3;  // beside the grains

FilmPlot read_plot(Document& document, const std::vector<MeasureColumn>& columns, const std::string& table) {
    const std::string name = document.required_text(table + ".y");
    const MeasureColumn* column = find_column(columns, name);
    if (column == nullptr)
        document.fail(table + ".y",
                      fmt::format("must be a column of measures.csv, but is \"{}\"; there are {}",
                                  excerpt(name), column_names(columns)));
    FilmPlot plot;
    plot.column = column->name;
    plot.label = document.text(table + ".label").value_or(column->label);
    plot.range = document.interval(table + ".range", column->dimension);
    if (plot.range && !((*plot.range)[0] < (*plot.range)[1]))
        document.fail(table + ".range", "must rise, from low to high; exchange them or widen it");
    return plot;
}

std::vector<MeasureColumn> columns_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Species& species : scene.species) names.push_back(species.name);
    return measure_columns(names);
}

void read_text(Document& document, const Scene& scene, FilmShows& look) {
    look.text = document.text("film.text").value_or("");
    try {
        look.live_words = parse_live_text(look.text, columns_of(scene));
    } catch (const UserError& error) {
        document.fail("film.text", error.what());
    }
}

void read_plots(Document& document, Scene& scene) {
    const std::vector<MeasureColumn> columns = columns_of(scene);
    const std::size_t count = document.size("film.plot");
    if (count > most_plots)
        document.fail("film.plot", fmt::format("are {}, but only {} fit beside the grains; remove some",
                                               count, most_plots));
    for (std::size_t i = 0; i < count; ++i)
        scene.film.shows.plots.push_back(read_plot(document, columns, fmt::format("film.plot[{}]", i)));
}

void read_arrows(Document& document, const Scene& scene, FilmArrows& arrows) {
    if (!document.is_table("film.arrows")) return;
    const auto across = document.integer("film.arrows.grid");
    if (!across) document.fail_missing("film.arrows.grid");
    arrows.across = static_cast<int>(*across);
    arrows.period =
        chosen<bool>(document, "film.arrows.of", {{"period", true}, {"now", false}}, scene.drive.present);
    if (arrows.period && !scene.drive.present)
        document.fail("film.arrows.of",
                      "is \"period\", but nothing oscillates; add [drive] or write \"now\"");
    // A grain's diameter in five periods is a fast circulation.
    const double usual =
        arrows.period ? 0.1 * usual_range(GrainValue::displacement, scene)[1] * 2 * scene.drive.frequency
                      : usual_range(GrainValue::speed, scene)[1];
    arrows.speed = document.quantity("film.arrows.speed").value_or(usual);
    if (arrows.speed <= 0) document.fail("film.arrows", "need a 'speed': this scene gives no scale for it");
}

// "speed > 20 cm/s": a quantity that can colour grains, < or >, a value of it.
void read_condition(Document& document, const Scene& scene, GrainCondition& condition) {
    const char* const path = "film.highlight_if";
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

void read_trails(Document& document, const Scene& scene, FilmTrails& trails) {
    if (!document.is_table("film.trails")) return;
    trails.species = species_list(document, scene, "film.trails.species");
    trails.grains = ids_at(document, scene, "film.trails.grains");
    const bool emptied = document.has("film.trails.species") || document.has("film.trails.grains");
    if (!trails.wanted() && !emptied)
        document.fail("film.trails", "need 'species' or 'grains'; write for example grains = [3, 14]");
    const double usual =
        scene.drive.present ? usual_trail_periods / scene.drive.frequency : 0.1 * scene.run.duration;
    trails.duration = document.quantity("film.trails.duration").value_or(usual);
}

}  // namespace

void read_shows(Document& document, Scene& scene) {
    FilmShows& look = scene.film.shows;
    read_colour(document, scene, look.colour);
    look.hidden = species_list(document, scene, "film.hide");
    look.ghosts = species_list(document, scene, "film.ghost");
    for (const std::size_t ghost : look.ghosts)
        if (std::find(look.hidden.begin(), look.hidden.end(), ghost) != look.hidden.end())
            document.fail("film.ghost",
                          fmt::format("names \"{}\", which film.hide takes away; keep one of them",
                                      scene.species[ghost].name));
    look.highlighted = ids_at(document, scene, "film.highlight");
    read_condition(document, scene, look.highlight_if);
    read_text(document, scene, look);
    read_plots(document, scene);
    read_arrows(document, scene, look.arrows);
    read_trails(document, scene, look.trails);
    look.force_chains = document.flag("film.force_chains").value_or(look.force_chains);
}

}  // namespace grainreel
