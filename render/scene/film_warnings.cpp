// Warnings that the film adds to those of the plan. They need the engine's plan, so they have a file of their
// own, which programs that only draw do not link.
#include <fmt/format.h>

#include <algorithm>

#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/warnings.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// Warns of default colours that repeat the colour of another species, because the palette has no colour left.
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

void warn_of_empty_plots(const FilmedScene& scene, Warnings& warnings) {
    const std::vector<FilmPlot>& plots = scene.film.shows.plots;
    for (std::size_t i = 0; i < plots.size(); ++i) {
        if (plots[i].is_profile()) continue;
        const std::string why = why_column_is_empty(scene, plots[i].column);
        if (!why.empty())
            warnings.add(
                fmt::format("film.plot[{}].y", i),
                fmt::format("the plot of '{}' stays empty: {}; plot another column", plots[i].column, why));
    }
}

}  // namespace

Plan plan_with_film(const FilmedScene& scene) {
    return with_film_warnings(scene, make_plan(scene));
}

Plan with_film_warnings(const FilmedScene& scene, Plan plan) {
    Warnings warnings(scene);
    warn_of_colours(scene, warnings);
    warn_of_end(scene, warnings);
    warn_of_empty_plots(scene, warnings);
    for (std::string& warning : warnings.take()) plan.warnings.push_back(std::move(warning));
    return plan;
}

}  // namespace grainreel
