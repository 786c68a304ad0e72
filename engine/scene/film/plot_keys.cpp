// The keys of [[film.plot]], [film.arrows] and [film.trails].
#include <fmt/format.h>

#include "engine/base/utf8.hpp"
#include "engine/scene/film/film_keys.hpp"
#include "engine/scene/film/grain_values.hpp"
#include "engine/scene/film/live_text.hpp"
#include "engine/scene/film/named_grains.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

constexpr std::size_t most_plots = 3;  // beside the grains
constexpr double usual_trail_periods = 10;

void read_column(Document& document, const Scene& scene, const std::string& path, FilmPlot& plot) {
    const std::string name = document.required_text(path);
    const std::vector<MeasureColumn>& columns = scene.measurable.columns;
    const MeasureColumn* column = find_column(columns, name);
    if (column == nullptr)
        document.fail(path, fmt::format("must be a column of measures.csv, but is \"{}\"; there are {}",
                                        excerpt(name), column_names(columns)));
    plot.column = column->name;
    plot.label = column->label;
    plot.dimension = column->dimension;
}

void read_range(Document& document, const Scene&, const std::string& path, FilmPlot& plot) {
    plot.range = document.interval(path, plot.dimension);
    if (plot.range && !((*plot.range)[0] < (*plot.range)[1]))
        document.fail(path, "must rise, from low to high; exchange them or widen it");
}

const KeyTable<FilmPlot>& plot_table() {
    using P = FilmPlot;
    static const KeyTable<P> table{
        bound_by<P>(entry("y", KeyKind::text, required(),
                          "A column of measures.csv, drawn against time: height_difference, lacey, kinetic."),
                    read_column, [](const P& plot, const Scene&) { return quoted(plot.column); }),
        text("label", &P::label, note("by the column"), "Above the plot."),
        bound_by<P>(
            entry("range", KeyKind::interval, note("grows with the data"), "Of the vertical axis."),
            read_range,
            [](const P& plot, const Scene&) {
                return plot.range ? toml_list({as_toml((*plot.range)[0]), as_toml((*plot.range)[1])}) : "";
            }),
    };
    return table;
}

// A grain's diameter in five periods is a fast circulation.
void usual_speed(FilmArrows& arrows, const Scene& scene) {
    arrows.speed = arrows.period ? 0.1 * usual_range(GrainValue::displacement, scene)[1] * 2 *
                                       scene.drive.highest_frequency()
                                 : usual_range(GrainValue::speed, scene)[1];
}

const KeyTable<FilmArrows>& arrow_table() {
    using A = FilmArrows;
    static const Words<bool> spans{{"period", true}, {"now", false}};
    static const KeyTable<A> table{
        integer("grid", &A::across, 2, 100, note("required in this table"),
                "Cells across the container's width; one arrow each: the grains' mean velocity."),
        choice("of", &A::period, spans, note("period with a drive, else now"),
               "Of the last period of the drive, or of this moment.")
            .usually([](A& arrows, const Scene& scene) { arrows.period = scene.drive.present; }),
        quantity("speed", &A::speed, Dimension::speed, positive,
                 note("a diameter in five periods; of now: the drive's"),
                 "Of an arrow as long as a cell is wide.")
            .usually(usual_speed),
    };
    return table;
}

const KeyTable<FilmTrails>& trail_table() {
    using T = FilmTrails;
    static const KeyTable<T> table{
        species_key("species", &T::species, "Species whose grains leave trails."),
        ids_key("grains", &T::grains, "Ids of grains that leave trails."),
        quantity("duration", &T::duration, Dimension::time, positive,
                 note("10 periods; a tenth of the run without a drive"), "How long they are.")
            .usually([](T& trails, const Scene& scene) {
                trails.duration = scene.drive.present ? usual_trail_periods / scene.drive.frequency
                                                      : 0.1 * scene.run.duration;
            }),
    };
    return table;
}

void read_arrows(Document& document, Scene& scene) {
    FilmArrows& arrows = scene.film.shows.arrows;
    if (!document.is_table("film.arrows")) return;
    if (!document.has("film.arrows.grid")) document.fail_missing("film.arrows.grid");
    arrow_table().read(document, scene, "film.arrows", arrows);
    if (arrows.period && !scene.drive.present)
        document.fail("film.arrows.of",
                      "is \"period\", but nothing oscillates; add [drive] or write \"now\"");
    if (arrows.speed <= 0) document.fail("film.arrows", "need a 'speed': this scene gives no scale for it");
}

void read_trails(Document& document, Scene& scene) {
    if (!document.is_table("film.trails")) return;
    if (!document.has("film.trails.species") && !document.has("film.trails.grains"))
        document.fail("film.trails", "need 'species' or 'grains'; write for example grains = [3, 14]");
    trail_table().read(document, scene, "film.trails", scene.film.shows.trails);
}

}  // namespace

void list_plots(Keys& all) {
    plot_table().list(all, "film.plot[]");
}

void list_arrows_and_trails(Keys& all) {
    arrow_table().list(all, "film.arrows");
    trail_table().list(all, "film.trails");
}

void read_plots(Document& document, Scene& scene) {
    const std::size_t count = document.size("film.plot");
    if (count > most_plots)
        document.fail("film.plot", fmt::format("are {}, but only {} fit beside the grains; remove some",
                                               count, most_plots));
    for (std::size_t i = 0; i < count; ++i)
        plot_table().read(document, scene, fmt::format("film.plot[{}]", i),
                          scene.film.shows.plots.emplace_back());
}

void read_arrows_and_trails(Document& document, Scene& scene) {
    read_arrows(document, scene);
    read_trails(document, scene);
}

void write_plots(SceneText& out, const Scene& scene) {
    for (const FilmPlot& plot : scene.film.shows.plots) {
        out.element("film.plot");
        plot_table().write(out, scene, plot);
    }
}

void write_arrows_and_trails(SceneText& out, const Scene& scene) {
    const FilmShows& shows = scene.film.shows;
    if (shows.arrows.across > 0) {
        out.table("film.arrows");
        arrow_table().write(out, scene, shows.arrows);
    }
    if (!shows.trails.wanted()) return;
    out.table("film.trails");
    trail_table().write(out, scene, shows.trails);
}

}  // namespace grainreel
