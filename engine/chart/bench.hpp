// Grains of one kind, faces and a loop over them, on one thread: what the charts' experiments are built on.
#pragma once

#include <memory>
#include <numbers>

#include "engine/step/step_loop.hpp"

namespace grainreel {

struct Bench {
    Plan plan;
    Surroundings around;
    Grains grains;
    Team team{1};
    std::unique_ptr<StepLoop> loop;
    std::int64_t step = 0;

    // The contact holds among the grains and at walls; step_length in s.
    Bench(const PairPlan& pair, double step_length) {
        plan.grain = plan.wall = {pair};
        plan.clock.step = step_length;
    }
    // radius: m; density: kg/m3.
    void add(const Vec3& position, const Vec3& velocity, double radius, double density) {
        grains.add(static_cast<std::int32_t>(grains.size()), 0, position, radius, density);
        grains.motion.back().velocity = velocity;
    }
    Face& add_plane(const Vec3& point, const Vec3& normal) {
        Face face;
        face.point = point;
        face.normal = normal;
        around.faces.push_back(face);
        return around.faces.back();
    }
    void start() {
        if (around.skin == 0) around.skin = 0.2 * grains.place[0].radius;
        loop = std::make_unique<StepLoop>(plan, around, grains, team);
        loop->restart();
    }
    // drag: 1/s, on every velocity and spin.
    void run(std::int64_t count, double drag = 0) {
        loop->run(step, count, plan.clock.step, drag);
        step += count;
    }
};

inline double sphere_volume(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

}  // namespace grainreel
