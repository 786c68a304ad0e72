// The keys of [[film.plot]], [film.arrows], [film.streamlines] and [film.trails].
#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/live_text.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

using namespace keys;

constexpr std::size_t most_plots = 3;  // beside the grains
constexpr double usual_trail_periods = 10;

const ChoiceWords<bool> velocity_spans{{"period", true}, {"now", false}};

const ChoiceWords<ProfileOf> profile_words{{"solid-fraction", ProfileOf::solid_fraction},
                                           {"share", ProfileOf::share},
                                           {"horizontal-velocity", ProfileOf::horizontal_velocity},
                                           {"vertical-velocity", ProfileOf::vertical_velocity}};

Word usual_label(ProfileOf profile) {
    switch (profile) {
        case ProfileOf::share:
            return Word::share;
        case ProfileOf::horizontal_velocity:
            return Word::horizontal_velocity;
        case ProfileOf::vertical_velocity:
            return Word::vertical_velocity;
        case ProfileOf::solid_fraction:
        case ProfileOf::nothing:
            break;
    }
    return Word::solid_fraction;
}

void read_profile(Document& document, const Scene& scene, const std::string& path, FilmPlot& plot) {
    const auto word = document.text(path);
    if (!word) return;
    for (const auto& [said, value] : profile_words)
        if (*word == said) plot.profile = value;
    plot.dimension = plot.of_velocity() ? Dimension::speed : Dimension::number;
    plot.period = plot.of_velocity() && scene.drive.present;
}

const char* without_profile(const FilmPlot& plot) {
    return plot.is_profile() ? nullptr : "it is a profile's, and there is no 'profile'";
}

const char* without_velocity(const FilmPlot& plot) {
    return plot.of_velocity() ? nullptr : "only profiles of velocities have it";
}

void read_column(Document& document, const Scene& scene, const std::string& path, FilmPlot& plot) {
    if (plot.is_profile()) return;
    if (!document.has(path)) document.fail_missing(path);
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
    static const ChoiceWords<bool> directions{{"height", false}, {"width", true}};
    static const ChoiceWords<bool> smoothings{{"none", false}, {"period", true}};
    static const KeyTable<P> table{
        bound_by<P>(
            of_choices(
                entry("profile", KeyKind::choice, note("none"),
                      "In place of `y`: a profile at the moment of each picture, by species or of a mean "
                      "velocity."),
                all_of(profile_words)),
            read_profile,
            [](const P& plot, const Scene&) {
                return plot.is_profile() ? quoted(word_of(plot.profile, profile_words)) : "";
            }),
        choice("over", &P::across, directions, note("height"),
               "A profile is drawn against the height above the floor, or against the place across the "
               "width.")
            .useless_for(without_profile),
        choice("of", &P::period, velocity_spans, note("period with a drive, else now"),
               "Of a profile of velocities: as in [film.arrows].")
            .useless_for(without_velocity),
        bound_by<P>(entry("y", KeyKind::text, note("required, or `profile`"),
                          "A column of measures.csv, drawn against time: height_difference, lacey, kinetic."),
                    read_column,
                    [](const P& plot, const Scene&) { return plot.is_profile() ? "" : quoted(plot.column); })
            .useless_for([](const P& plot) {
                return plot.is_profile() ? "a plot with a 'profile' shows that" : nullptr;
            }),
        choice("smooth", &P::period, smoothings,
               note("period with a drive and three periods or more, else none"),
               "period: the line of a column is the mean over the last period of the drive, and its rows are "
               "a faint line behind it; none: the rows alone.")
            .useless_for([](const P& plot) {
                return plot.is_profile() ? "a 'profile' is of one moment, or says 'of'" : nullptr;
            })
            .usually([](P& plot, const Scene& scene) {
                constexpr double least_periods = 3;  // a shorter run has hardly a mean to show
                if (!plot.is_profile())
                    plot.period =
                        scene.drive.present && scene.run.duration * scene.drive.frequency >= least_periods;
            }),
        quantity(
            "window", &P::window, Dimension::time, positive, note("the whole run"),
            "The axis of time is so long and moves along, so that single bounces or periods can be seen.")
            .useless_for([](const P& plot) {
                return plot.is_profile() ? "a 'profile' is not drawn against time" : nullptr;
            })
            .unwritten_if([](const P& plot) { return !(plot.window > 0); }),
        text("label", &P::label, note("by the column"), "Above the plot.").unwritten_if([](const P& plot) {
            return !plot.own_label;
        }),
        bound_by<P>(
            entry("range", KeyKind::interval, note("grows with the data; of a profile: by the scene"),
                  "Of the values' axis."),
            read_range,
            [](const P& plot, const Scene&) {
                return plot.range ? toml_list({as_toml((*plot.range)[0]), as_toml((*plot.range)[1])}) : "";
            }),
    };
    return table;
}

const KeyTable<FilmArrows>& arrow_table() {
    using A = FilmArrows;
    static const KeyTable<A> table{
        integer("grid", &A::across, 2, 100, note("required in this table"),
                "Cells across the container's width; one arrow each: the grains' mean velocity."),
        choice("of", &A::period, velocity_spans, note("period with a drive, else now"),
               "Of the last period of the drive, or of this moment.")
            .usually([](A& arrows, const Scene& scene) { arrows.period = scene.drive.present; }),
        quantity("speed", &A::speed, Dimension::speed, positive,
                 note("a diameter in five periods; of now: the drive's, or a fall's at an outlet"),
                 "An arrow of this speed spans one cell.")
            .usually(
                [](A& arrows, const Scene& scene) { arrows.speed = usual_flow_speed(scene, arrows.period); }),
    };
    return table;
}

const KeyTable<FilmStreamlines>& streamline_table() {
    using S = FilmStreamlines;
    static const KeyTable<S> table{
        integer("grid", &S::across, 2, 100, note("required in this table"),
                "Lines across the container's width: pieces of streamlines of the grains' mean velocity."),
        choice("of", &S::period, velocity_spans, note("period with a drive, else now"),
               "As in [film.arrows].")
            .usually([](S& lines, const Scene& scene) { lines.period = scene.drive.present; }),
        quantity("speed", &S::speed, Dimension::speed, positive,
                 note("a diameter in five periods; of now: the drive's, or a fall's at an outlet"),
                 "Lines have their full width at this speed and above; slower ones are thinner.")
            .usually(
                [](S& lines, const Scene& scene) { lines.speed = usual_flow_speed(scene, lines.period); }),
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

void check_period(const Document& document, const Scene& scene, const std::string& path, bool period,
                  const char* instead = "now") {
    if (period && !scene.drive.present)
        document.fail(
            path, fmt::format("is \"period\", but nothing oscillates; add [drive] or write \"{}\"", instead));
}

// Reads arrows or streamlines.
template <class Marks>
void read_flow(Document& document, const Scene& scene, const std::string& path, const KeyTable<Marks>& table,
               Marks& marks) {
    if (!document.is_table(path)) return;
    if (!document.has(path + ".grid")) document.fail_missing(path + ".grid");
    table.read(document, scene, path, marks);
    check_period(document, scene, path + ".of", marks.period);
    if (marks.speed <= 0) document.fail(path, "needs a 'speed': this scene gives no scale for it");
}

void read_trails(Document& document, FilmedScene& scene) {
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
    streamline_table().list(all, "film.streamlines");
    trail_table().list(all, "film.trails");
}

void read_plots(Document& document, FilmedScene& scene) {
    const std::size_t count = document.size("film.plot");
    if (count > most_plots)
        document.fail("film.plot", fmt::format("are {}, but only {} fit beside the grains; remove some",
                                               count, most_plots));
    for (std::size_t i = 0; i < count; ++i) {
        const std::string path = fmt::format("film.plot[{}]", i);
        FilmPlot& plot = scene.film.shows.plots.emplace_back();
        plot_table().read(document, scene, path, plot);
        if (plot.is_profile())
            check_period(document, scene, path + ".of", plot.period);
        else
            check_period(document, scene, path + ".smooth", plot.period, "none");
        plot.own_label = document.has(path + ".label");
        if (!plot.own_label)
            plot.label = plot.is_profile() ? scene.film.wording(usual_label(plot.profile))
                                           : phrase(scene.film.wording.language, plot.label);
        if (plot.is_profile() && !plot.range && !(usual_profile_range(scene, plot)[1] > 0))
            document.fail(path, "needs a 'range': this scene gives no scale for it");
    }
}

void read_arrows_and_trails(Document& document, FilmedScene& scene) {
    FilmShows& shows = scene.film.shows;
    read_flow(document, scene, "film.arrows", arrow_table(), shows.arrows);
    read_flow(document, scene, "film.streamlines", streamline_table(), shows.streamlines);
    read_trails(document, scene);
}

void write_plots(SceneText& out, const FilmedScene& scene) {
    for (const FilmPlot& plot : scene.film.shows.plots) {
        out.element("film.plot");
        plot_table().write(out, scene, plot);
    }
}

void write_arrows_and_trails(SceneText& out, const FilmedScene& scene) {
    const FilmShows& shows = scene.film.shows;
    if (shows.arrows.across > 0) {
        out.table("film.arrows");
        arrow_table().write(out, scene, shows.arrows);
    }
    if (shows.streamlines.across > 0) {
        out.table("film.streamlines");
        streamline_table().write(out, scene, shows.streamlines);
    }
    if (!shows.trails.wanted()) return;
    out.table("film.trails");
    trail_table().write(out, scene, shows.trails);
}

}  // namespace grainreel
