// A small simulation for the experiments of charts: a few grains, faces and laws put together by hand,
// without a scene.
#pragma once

#include <memory>
#include <numbers>

#include "engine/measure/energy.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// The grain and the contact of most experiments; results are given in units of these.
constexpr double bench_radius = 0.002, bench_density = 2500, bench_stiffness = 1e5;  // m, kg/m3, N/m
inline double sphere_volume(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}
inline double sphere_mass_of(double radius, double density = bench_density) {
    return density * sphere_volume(radius);
}
inline double bench_mass() {
    return sphere_mass_of(bench_radius);
}

// Walton-Braun with a constant restitution, and incremental slip where there is friction.
inline PairPlan latching_pair(double stiffness, double restitution, double friction = 0,
                              Precision precision = Precision::full) {
    PairPlan pair;
    pair.model = {NormalForce::walton_braun,
                  friction > 0 ? TangentialLaw::incremental_slip : TangentialLaw::none, false, precision};
    pair.restitution = restitution;
    pair.loading_stiffness = stiffness;
    pair.unloading_stiffness = stiffness / (restitution * restitution);
    pair.tangential_ratio = 0.8;
    pair.tangential_stiffness = 0.8 * stiffness;
    pair.gamma = 1.0 / 3;
    pair.friction = friction;
    return pair;
}

// A small world runs on one thread. Its loop refers to the other members, so it must not be copied or
// moved.
struct SmallWorld {
    Plan plan;
    Surroundings around;
    Grains grains;
    Team team{1};
    std::unique_ptr<StepLoop> loop;
    std::int64_t step = 0;

    SmallWorld(const PairPlan& contact, double step_length,
               Integrator integrator = Integrator::velocity_verlet) {
        plan.integrator = integrator;
        plan.grain = plan.wall = {contact};
        plan.clock.step = step_length;
        around.skin = 0.2 * bench_radius;
    }
    explicit SmallWorld(const Plan& planned, double skin) : plan(planned) { around.skin = skin; }

    Face& add_plane(const Vec3& point, const Vec3& normal) {
        Face face;
        face.name = "plane";
        face.point = point;
        face.normal = normal;
        around.faces.push_back(face);
        return around.faces.back();
    }
    void add_floor() { add_plane(Vec3::Zero(), Vec3(0, 0, 1)); }

    struct Sphere {
        double radius = bench_radius, density = bench_density;  // m, kg/m3
        std::int32_t species = 0;
    };
    // Grains are numbered in the order in which they are added.
    void add(const Vec3& position, const Vec3& velocity = Vec3::Zero()) { add(position, velocity, Sphere()); }
    void add(const Vec3& position, const Vec3& velocity, const Sphere& sphere) {
        const auto id = static_cast<std::int32_t>(grains.size());
        grains.add(id, sphere.species, position, sphere.radius, sphere.density);
        grains.motion.back().velocity = velocity;
    }
    void start() {
        loop = std::make_unique<StepLoop>(plan, around, grains, team);
        loop->restart();
    }
    // drag (1/s) acts on every velocity and spin.
    void run(std::int64_t count, double drag = 0) {
        loop->run(step, count, plan.clock.step, drag);
        step += count;
    }

    // Index of the grain with this number. The loop keeps grains in spatial order.
    std::size_t at(std::int32_t id) const {
        std::size_t i = 0;
        while (grains.id[i] != id) ++i;
        return i;
    }
    Vec3& position(std::int32_t id) { return grains.place[at(id)].position; }
    Vec3& velocity(std::int32_t id) { return grains.motion[at(id)].velocity; }
    Vec3& spin(std::int32_t id) { return grains.motion[at(id)].spin; }
    double kinetic() const {  // J
        const Kinetic k = kinetic_energy(grains);
        return k.translation + k.rotation;
    }
};

}  // namespace grainreel
