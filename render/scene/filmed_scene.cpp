#include "render/scene/filmed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/plan/resolved_scene.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/scene/colours.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

// What the film shows is measured, and orientations are kept where it shows how grains turn.
Wishes wishes_of(const FilmedScene& scene) {
    Wishes wishes;
    const auto take_instrument = [&](const std::string& name) {
        std::vector<std::string>& taken = wishes.instruments;
        if (std::find(taken.begin(), taken.end(), name) == taken.end()) taken.push_back(name);
    };
    const auto take = [&](const std::string& name) {
        for (const MeasureColumn& column : scene.measurable.columns)
            if (column.name == name && !column.instrument.empty()) take_instrument(column.instrument);
    };
    const FilmShows& shows = scene.film.shows;
    if (shows.wall_forces.wanted) take_instrument("walls");
    for (const FilmPlot& plot : shows.plots) take(plot.column);
    for (const LiveWords& words : shows.live_words) take(words.column);
    wishes.orientation = scene.film.look.rotation;
    return wishes;
}

// A default colour repeats another species' when the palette has none left.
void warn_of_colours(const FilmedScene& scene, Warnings& warnings) {
    const std::vector<Species>& species = scene.species;
    const std::vector<Colour>& colours = scene.colours;
    for (std::size_t i = 0; i < species.size(); ++i) {
        if (scene.written.count(fmt::format("species[{}].colour", i)) > 0) continue;
        for (std::size_t j = 0; j < species.size(); ++j) {
            if (i == j || colours[j] != colours[i]) continue;
            warnings.add(fmt::format("species[{}]", i),
                         fmt::format("\"{}\" and \"{}\" look alike: there are more species than default "
                                     "colours; give one a colour of its own, such as colour = \"#8b4513\"",
                                     species[std::min(i, j)].name, species[std::max(i, j)].name));
            return;
        }
    }
}

void warn_of_end(const FilmedScene& scene, Warnings& warnings) {
    double shown = 0;
    for (const FilmSegment& segment : scene.film.segments) {
        if (!segment.duration) return;
        shown += *segment.duration;
    }
    if (!scene.film.segments.empty() && shown < scene.run.duration * (1 - 1e-6))
        warnings.add(
            "film.segment",
            fmt::format("the film shows the first {:.4g} s of {:.4g} s; leave out one duration to show "
                        "the rest",
                        shown, scene.run.duration));
}

}  // namespace

void tell_engine(FilmedScene& scene) {
    SceneText text;
    write_film(text, scene);
    scene.film_text = text.take();
    for (std::size_t i = 0; i < scene.species.size() && i < scene.colours.size(); ++i)
        scene.species[i].colour_text = quoted(colour_text(scene.colours[i]));
    scene.wishes = wishes_of(scene);
}

Plan plan_with_film(const FilmedScene& scene) {
    return with_film_warnings(scene, make_plan(scene));
}

Plan with_film_warnings(const FilmedScene& scene, Plan plan) {
    Warnings warnings(scene);
    warn_of_colours(scene, warnings);
    warn_of_end(scene, warnings);
    for (std::string& warning : warnings.take()) plan.warnings.push_back(std::move(warning));
    return plan;
}

std::string resolved_scene(const FilmedScene& scene, const Plan& plan) {
    FilmedScene told = scene;
    tell_engine(told);
    return resolved_scene(static_cast<const Scene&>(told), plan);
}

}  // namespace grainreel
