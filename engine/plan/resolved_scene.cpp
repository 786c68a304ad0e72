#include "engine/plan/resolved_scene.hpp"

#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

double stiffness_of(const PairPlan& plan) {
    return plan.model.normal == NormalForce::hertz ? plan.modulus : plan.loading_stiffness;
}

// The contact of grains of one species with glued grains of the other; nullptr where none are glued.
const PairPlan* glued_plan(const Scene& scene, const Plan& plan, std::size_t a, std::size_t b) {
    if (plan.glued.empty()) return nullptr;
    const std::size_t glued = scene.container.wall_grains->species;
    return a == glued ? &plan.glued[b] : b == glued ? &plan.glued[a] : nullptr;
}

}  // namespace

Scene with_choices(Scene scene, const Plan& plan) {
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b) {
            PairContact& pair = scene.contact.grain[a * count + b];
            pair.stiffness = stiffness_of(plan.between(a, b));
            if (const PairPlan* glued = glued_plan(scene, plan, a, b))
                pair.glued_stiffness = stiffness_of(*glued);
        }
        scene.contact.wall[a].stiffness = stiffness_of(plan.wall[a]);
    }
    for (std::size_t k = 0; k < scene.contact.mesh.size(); ++k)
        scene.contact.mesh[k].stiffness = stiffness_of(plan.mesh[k]);
    const double step = plan.clock.step;
    scene.run.step = step;
    scene.run.steps_per_contact.reset();
    if (plan.trajectory_periods == 0) scene.output.trajectory_interval = plan.trajectory_every * step;
    if (plan.measures_periods == 0) scene.output.measures_interval = plan.measures_every * step;
    return scene;
}

Reasons reasons_of(const Scene& scene, const Plan& plan) {
    const std::size_t count = scene.species.size();
    Reasons reasons;
    if (!scene.run.step) reasons.step = plan.step_reason;
    reasons.grain.resize(count * count);
    reasons.glued.resize(count * count);
    reasons.wall.resize(count);
    reasons.mesh.resize(scene.contact.mesh.size());
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b) {
            const PairContact& pair = scene.between(a, b);
            const PairPlan* glued = glued_plan(scene, plan, a, b);
            const std::size_t kind = a * count + b;
            if (!pair.stiffness) reasons.grain[kind] = plan.between(a, b).stiffness_reason;
            if (glued && !pair.glued_stiffness && !pair.stiffness)
                reasons.glued[kind] = glued->stiffness_reason;
        }
        if (!scene.contact.wall[a].stiffness) reasons.wall[a] = plan.wall[a].stiffness_reason;
    }
    for (std::size_t k = 0; k < scene.contact.mesh.size(); ++k)
        if (!scene.contact.mesh[k].stiffness) reasons.mesh[k] = plan.mesh[k].stiffness_reason;
    return reasons;
}

std::string resolved_scene(const Scene& scene, const Plan& plan) {
    return written_scene(naming_kept_files(with_choices(scene, plan)), reasons_of(scene, plan));
}

}  // namespace grainreel
