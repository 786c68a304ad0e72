// Runs a scene and reads its grains, by the engine alone: two balls fly for a fifth of a second.
#include <cstdio>

#include "engine/run/folder/run_scene.hpp"
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
        [container]
        shape = "none"
        [run]
        duration = "0.2 s"
    )",
                                        "two_balls.toml");
    RunSceneOptions how;
    how.every = 0.05;
    how.look = [](const Frame& now) {
        for (std::size_t i = 0; i < now.size(); ++i)
            std::printf("%.12g s: grain %d at %.12g %.12g %.12g m\n", now.time, now.id[i],
                        now.position[i].x(), now.position[i].y(), now.position[i].z());
        return true;
    };
    run_scene(scene, how);
}
