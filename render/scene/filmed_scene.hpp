// A scene together with its film: what everything that draws or films works with. The engine runs the Scene
// in it and knows nothing of the rest.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

struct FilmedScene : Scene {
    Film film;
    std::vector<Colour> colours;  // one a species
};

// Whether walls have the colours of pressure or wear.
inline bool shows_wear(const FilmedScene& scene) {
    return scene.film.look.walls.coloured() && !scene.meshes.empty();
}

// Makes what the engine keeps of the film (Scene::film_text, the species' colours as text, Scene::wishes) say
// what the film says. The reader has done so; whoever changes the film of a scene that is to be run does it
// again.
void tell_engine(FilmedScene& scene);

// The plan, with the warnings that the film and its colours give as well.
Plan plan_with_film(const FilmedScene& scene);
Plan with_film_warnings(const FilmedScene& scene, Plan plan);

// As the engine's, with the film as it is now.
std::string resolved_scene(const FilmedScene& scene, const Plan& plan);

}  // namespace grainreel
