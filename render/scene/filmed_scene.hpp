// A scene together with its film. Everything that draws or films works with it; the engine runs the Scene in
// it and knows nothing of the rest.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

struct FilmedScene : Scene {
    Film film;
    std::vector<Colour> colours;  // one for each species
};

// Whether walls have the colours of pressure or wear.
inline bool shows_wear(const FilmedScene& scene) {
    return scene.film.look.walls.coloured() && !scene.meshes.empty();
}

// Brings what the engine keeps of the film (Scene::film_text, the species' colours as text, Scene::wishes) in
// line with the film. The reader does this. Whoever changes the film of a scene before it is run must do it
// again.
void tell_engine(FilmedScene& scene);

// The plan of a scene, with the warnings that the film and its colours give.
Plan plan_with_film(const FilmedScene& scene);
Plan with_film_warnings(const FilmedScene& scene, Plan plan);

// The engine's resolved_scene(), with the film as it is now.
std::string resolved_scene(const FilmedScene& scene, const Plan& plan);

}  // namespace grainreel
