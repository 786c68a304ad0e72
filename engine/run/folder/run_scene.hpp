// Runs a scene from its beginning to its end in one call, for programs that use the engine as a library.
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
// A frame's arrays have one entry per grain, in order of rising ids: position (m), velocity (m/s), spin
// (rad/s), radius (m), species (its place in scene.species). SI units throughout; z points up, and the origin
// is the middle of the floor at rest (engine/frame.hpp).
#pragma once

#include <filesystem>
#include <functional>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct RunSceneOptions {
    // Folder of the run's files: scene.toml, trajectory.nc, measures.csv and others that the scene asks for.
    // It must be new or empty. With an empty name nothing is written.
    std::filesystem::path folder{};
    // Threads of the engine; 0 for as many as the scene says, or as many as are useful. Their number does not
    // change the bits of the run.
    int threads = 0;
    // Simulated time (s) between the frames that look() gets, from the start of the drive on, each at the
    // nearest step; 0 for no frames.
    double every = 0;
    // Called with each of these frames, on the calling thread. If it returns false, the run ends there in
    // good order.
    std::function<bool(const Frame&)> look{};
};

struct SceneEnd {
    Frame frame;            // the last moment
    bool complete = false;  // false when look() ended it
};

// Packs the grains, if the scene does, and runs to the end of scene.run.duration. Throws UserError for
// mistakes in the scene or the folder, before there are results. Throws RunError if the run fails on its way
// (for example if it is not healthy, or the disk is full); files written until then stay. Exceptions of
// look() are passed on, with a folder as a RunError.
SceneEnd run_scene(const Scene& scene, const RunSceneOptions& how = {});

}  // namespace grainreel
