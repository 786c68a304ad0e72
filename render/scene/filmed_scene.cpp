// What the engine is told of a film: its text, colours and wishes.
#include "render/scene/filmed_scene.hpp"

#include <algorithm>

#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/scene/film.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

// The wishes of a film. The engine measures what the film shows, and keeps orientations where the film shows
// how grains turn.
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
    if (shows_wear(scene)) take_instrument("wear");
    for (const FilmPlot& plot : shows.plots) take(plot.column);
    for (const LiveWords& words : shows.live_words) take(words.column);
    wishes.orientation = scene.film.look.rotation;
    return wishes;
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

std::string resolved_scene(const FilmedScene& scene, const Plan& plan) {
    FilmedScene told = scene;
    tell_engine(told);
    return resolved_scene(static_cast<const Scene&>(told), plan);
}

}  // namespace grainreel
