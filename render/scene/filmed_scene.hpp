// A scene together with its film, and how both are read from a scene file. Everything that draws or films
// works with it; the engine runs the Scene in it and knows nothing of the rest.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

struct Plan;  // engine/plan/plan.hpp

struct FilmedScene : Scene {
    Film film;
    std::vector<Colour> colours;  // one for each species
};

// Whether walls have the colours of pressure or wear.
inline bool shows_wear(const FilmedScene& scene) {
    return scene.film.look.walls.coloured() && !scene.meshes.empty();
}

// Sets what the engine keeps of the film (Scene::film_text, the species' colours as text, Scene::wishes) from
// the film as it is now. The reader does this; code that changes the film of a scene before it is run must do
// it again.
void tell_engine(FilmedScene& scene);

// The plan of a scene, with warnings about the film and its colours.
Plan plan_with_film(const FilmedScene& scene);
Plan with_film_warnings(const FilmedScene& scene, Plan plan);

// The engine's resolved_scene(), with the film as it is now.
std::string resolved_scene(const FilmedScene& scene, const Plan& plan);

// All keys of a scene file: the engine's keys and the keys of [film].
const std::vector<Key>& filmed_scene_keys();
// Their JSON Schema.
std::string scene_schema();

// These two read a scene with its film: all that read_scene() of engine/scene/scene_file.hpp reads, and
// besides [film] (whose keys are in keys/) and the species' colours. measurable: columns that plots and live
// words may name.
FilmedScene read_filmed_scene(const std::filesystem::path& file, const Assignments& sets = {},
                              const MeasurableIn& measurable = nullptr);
FilmedScene read_filmed_scene_text(std::string_view text, const std::filesystem::path& file,
                                   const Assignments& sets = {}, const MeasurableIn& measurable = nullptr);

}  // namespace grainreel
