// A camera that is kept as a file, and used again on other runs.
//
// The file is the keys of [film.camera] of a scene, a line each: azimuth = 20. Lengths are in m, angles in
// degrees.
#pragma once

#include <filesystem>
#include <optional>

#include <CLI/App.hpp>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

struct CameraFiles {
    std::optional<std::filesystem::path> use, keep;
};

// --camera, and --keep-camera with `keep`.
void add_camera_file(CLI::App& verb, CameraFiles& files, bool keep = true);

// The file's keys come before what was set on the command line. Throws UserError with its line for what is no
// key of a camera.
void use_camera_file(const CameraFiles& files, Assignments& sets);

// Writes the camera that pictures are drawn with. Throws UserError where the file is there, RunError where it
// cannot be written.
void keep_camera_file(const CameraFiles& files, const Camera& camera);

}  // namespace grainreel
