// The keys of [film.colour]: what the colour of a grain stands for.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/keys/film_keys.hpp"
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

// The usual range begins at 0, which no logarithm reaches: then it goes over three powers of ten.
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

// Else as the quantity has it, also when a finished run is drawn again in other colours.
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

const KeyTable<C>& colour_table() {
    static const KeyTable<C> table{
        choice("by", &C::by, grain_value_words, initial(),
               "What a grain's colour stands for; see docs/guide/colours.md.")
            .owns({"map", "unit", "range", "layers", "as", "scale"}),
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
                          "Of the quantity, [\"0 m/s\", \"0.5 m/s\"]: the map's ends, for the whole film."),
                    read_range, range_text)
            .useless_for(by_species),
        bound_by<C>(
            entry("unit", KeyKind::text, note("one that fits the range"),
                  "Of the colour bar, for example \"cm/s\"."),
            read_unit,
            [](const C& colour, const Scene&) { return colour.unit.empty() ? "" : quoted(colour.unit); })
            .useless_for(of_pure_numbers),
        choice("as", &C::as_field, Words<bool>{{"grains", false}, {"field", true}}, initial(),
               "field: the grains' mean over the depth, by coarse-graining, as a layer before pale grains.")
            .useless_for(by_species),
        integer("layers", &C::layers, 2, 12, initial(), "Bands of start-height.").useless_for(without_bands),
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

}  // namespace grainreel
