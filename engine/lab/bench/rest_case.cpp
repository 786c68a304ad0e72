#include "engine/lab/bench/rest_case.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/team.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/scene_surroundings.hpp"

namespace grainreel {
namespace {

constexpr int kPart = 2500;            // grains of the bed that the whole is copies of
constexpr double kDiameter = 1e-3;     // m
constexpr double kAcross = 10.5;       // diameters of a part, which is then about 28 deep
constexpr std::int64_t kFall = 30000;  // steps until it lies, with drag
constexpr double kDrag = 20;           // 1/s

// Hertz and Mindlin, soft, so that the step is long: what a step costs does not depend on that.
Scene scene_of_part(int grains) {
    const double side = kAcross * kDiameter * std::sqrt(grains / static_cast<double>(kPart));
    return read_scene_text(fmt::format(R"(
[[species]]
name = "grain"
count = {0}
diameter = {1}
density = 2500
[contact]
law = "hertz"
modulus = 1e6
restitution = 0.7
friction = 0.5
[container]
shape = "box"
width = {2}
depth = {2}
height = 0.08
[run]
duration = 1
)",
                                       grains, kDiameter, side),
                           "rest.toml", {});
}

// Copies of a part, side by side. At the seams grains of two copies lie as they lay at the wall.
BenchBed bed_at_rest(int particles) {
    const int k =
        std::max(1, static_cast<int>(std::lround(std::sqrt(particles / static_cast<double>(kPart)))));
    const Scene scene = scene_of_part(particles / (k * k));
    BenchBed part;
    part.plan = make_plan(scene);
    part.around = make_surroundings(scene, part.plan);
    part.grains = place_in_layers(scene);
    Team team(1);
    grow_radii(scene, part.plan, part.around, part.grains, team, [](double, std::int64_t) { return true; });
    StepLoop loop(part.plan, part.around, part.grains, team);
    loop.restart();
    loop.run(-kFall, kFall, part.plan.clock.step, kDrag);
    return copied(part, part.grains, 2 * scene.container.half_width, k);
}

}  // namespace

BenchCase rest_case() {
    return {"rest",
            "a bed at rest, Hertz-Mindlin: all contacts at once",
            25000,
            0,
            6000,
            kDrag,
            {{"at rest", 3000}},
            bed_at_rest};
}

}  // namespace grainreel
