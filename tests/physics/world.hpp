// A few grains, faces and laws, put together by hand, on which closed forms are tested.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include "engine/measure/energy.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct HandMadeBed {
    Plan plan;
    Surroundings around;
    Grains grains;
    std::unique_ptr<Team> team = std::make_unique<Team>(1);
    std::unique_ptr<StepLoop> loop;
    std::int64_t step = 0;

    void start() {
        if (around.skin == 0) around.skin = 0.2 * grains.place[0].radius;
        loop = std::make_unique<StepLoop>(plan, around, grains, *team);
        loop->restart();
    }
    void run(std::int64_t count) {
        loop->run(step, count, plan.clock.step, 0);
        step += count;
    }
    std::size_t index_of(std::int32_t id) const {
        for (std::size_t i = 0; i < grains.size(); ++i) {
            if (grains.id[i] == id) return i;
        }
        return grains.size();
    }
    const Vec3& position(std::int32_t id) const { return grains.place[index_of(id)].position; }
    const Vec3& velocity(std::int32_t id) const { return grains.motion[index_of(id)].velocity; }
    const Vec3& spin(std::int32_t id) const { return grains.motion[index_of(id)].spin; }
    double energy() const {
        const Kinetic k = kinetic_energy(grains);
        return k.translation + k.rotation + gravitational_energy(grains, around.gravity) +
               summarise_contacts(*loop, step).stored;
    }
};

constexpr double kRadius = 0.002;   // m
constexpr double kDensity = 2500;   // kg/m3
constexpr double kStiffness = 1e5;  // N/m
inline double sphere_mass(double radius = kRadius) {
    return kDensity * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

inline PairPlan walton_braun_pair(double e, double friction, double tangential_ratio = 0.8) {
    PairPlan p;
    p.loading_stiffness = kStiffness;
    p.unloading_stiffness = kStiffness / (e * e);
    p.tangential_stiffness = tangential_ratio * kStiffness;
    p.gamma = 1.0 / 3.0;
    p.restitution = e;
    p.friction = friction;
    return p;
}

// If GRAINREEL_TEST_PRECISION=mixed asks for it, worlds compute their laws in floats.
inline bool mixed_precision() {
    const char* wanted = std::getenv("GRAINREEL_TEST_PRECISION");
    return wanted && std::string(wanted) == "mixed";
}

inline Precision tested_precision() {
    return mixed_precision() ? Precision::mixed : Precision::full;
}
// Puts the tested precision before the settings of a scene, which may override it.
inline std::vector<std::string> with_tested_precision(std::vector<std::string> sets) {
    if (mixed_precision()) sets.insert(sets.begin(), "run.precision=mixed");
    return sets;
}

// The bound for rounding of a quantity: in doubles, or with laws in floats.
inline double of_rounding(double in_doubles, double in_floats) {
    return mixed_precision() ? in_floats : in_doubles;
}

// A world of one species with the same contact everywhere and nothing around it.
inline HandMadeBed make_world(PairPlan pair, double step, NormalForce normal = NormalForce::walton_braun,
                              TangentialLaw tangential = TangentialLaw::incremental_slip) {
    HandMadeBed w;
    pair.model.normal = normal;
    pair.model.tangential = tangential;
    pair.model.precision = tested_precision();
    w.plan.grain.assign(1, pair);
    w.plan.wall.assign(1, pair);
    w.plan.clock.step = step;
    return w;
}

inline Face ceiling_face(double height) {
    Face f;
    f.name = "ceiling";
    f.point.z() = height;
    f.normal = Vec3(0, 0, -1);
    return f;
}

inline Face floor_face() {
    Face f;
    f.name = "floor";
    f.normal = Vec3(0, 0, 1);
    return f;
}

}  // namespace grainreel
