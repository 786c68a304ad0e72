// Runs a scene and reads its grains, by the engine alone: two balls fly for a fifth of a second.
#include <cstdio>

#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/file/reader.hpp"

int main() {
    using namespace grainreel;
    const Scene scene = read_scene_text(R"(
        [[species]]
        name = "steel"
        diameter = "6 mm"
        density = "7.8 g/cm3"
        [[grain]]
        position = ["0 mm", "0 mm", "1 m"]
        [[grain]]
        position = ["0 mm", "50 mm", "1 m"]
        velocity = ["0 m/s", "2 m/s", "3 m/s"]
        [run]
        duration = "0.2 s"
    )",
                                        "two_balls.toml");
    const Plan plan = make_plan(scene);
    Simulation run(scene, plan, 1);
    run.pack();
    run.advance(plan.steps);
    const Frame frame = run.frame();
    for (std::size_t i = 0; i < frame.size(); ++i)
        std::printf("%d %.12g  %.12g %.12g %.12g\n", frame.id[i], frame.time, frame.position[i].x(),
                    frame.position[i].y(), frame.position[i].z());
}
