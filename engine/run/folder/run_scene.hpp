// A scene run from its beginning to its end, in one call: for programs that use the engine as a library.
//
//     const Scene scene = read_scene("hopper.toml", {}, measurable_in);
//     RunSceneOptions how;
//     how.folder = "output/hopper";
//     how.every = 0.1;
//     how.look = [](const Frame& now) {
//         for (std::size_t i = 0; i < now.size(); ++i) use(now.time, now.id[i], now.position[i]);
//         return true;
//     };
//     const SceneEnd end = run_scene(scene, how);
//
// A frame's arrays have one entry a grain, in order of rising ids: position (m), velocity (m/s), spin
// (rad/s), radius (m), species (its place in scene.species). SI units throughout; z points up, and the origin
// is the middle of the floor at rest (engine/frame.hpp).
#pragma once

#include <filesystem>
#include <functional>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct RunSceneOptions {
    // Where the run's files go: scene.toml, trajectory.nc, measures.csv and what else the scene asks for. New
    // or empty. An empty name: nothing is written.
    std::filesystem::path folder{};
    // Threads of the engine; 0: as the scene says, or as many as are of use. Their number changes no bit of
    // the run.
    int threads = 0;
    // s of simulated time between the frames that are looked at, from the start of the drive on, each at the
    // step that is nearest; 0: none is.
    double every = 0;
    // Sees each of them, on the calling thread; false ends the run there in good order.
    std::function<bool(const Frame&)> look{};
};

struct SceneEnd {
    Frame frame;            // the last moment
    bool complete = false;  // false when look() ended it
};

// Packs the grains, if the scene does, and runs to the end of scene.run.duration. Throws UserError for what
// is wrong with the scene or the folder, before anything is worth keeping; RunError when the run fails on its
// way (it stopped being healthy, the disk is full): what was written until then stays. What look() throws
// comes through, with a folder as a RunError.
SceneEnd run_scene(const Scene& scene, const RunSceneOptions& how = {});

}  // namespace grainreel
