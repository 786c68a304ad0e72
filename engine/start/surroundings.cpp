#include "engine/start/surroundings.hpp"

#include <algorithm>

#include "engine/state/outlet_faces.hpp"

namespace grainreel {
namespace {

constexpr double kSkinShare = 0.4;  // of the smallest radius

double smallest_radius(const Scene& scene) {
    double smallest = scene.species[0].diameter.smallest;
    for (const Species& s : scene.species) smallest = std::min(smallest, s.diameter.smallest);
    return 0.5 * smallest;
}

}  // namespace

Surroundings make_surroundings(const Scene& scene, const Plan& plan) {
    Surroundings around;
    around.faces = faces_of(scene);
    around.glued = glue_grains(scene, around.faces);
    around.motion = WallMotion(scene.drive, plan.clock);
    around.gravity = scene.gravity;
    around.period = period_of_depth(scene.container);
    around.skin = kSkinShare * smallest_radius(scene);
    return around;
}

void open_outlet(const Scene& scene, Surroundings& around) {
    open_outlet(scene.container, around.faces);
    if (!scene.container.tray) around.exits = {exit_below(-scene.container.outlet->exit_depth)};
}

}  // namespace grainreel
