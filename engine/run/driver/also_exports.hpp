// A run in formats of other programs ([output] also): RUN/also/vtk/, RUN/also/gsd.gsd. They are made of the
// run's own files after the run has stopped, at its end or before, so that they cost a running run nothing.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/scene/scene.hpp"

namespace grainreel {

// Throws UserError, with the place in the scene, for a format that this scene's runs cannot have.
void check_also(const Scene& scene);

// "vtk", "gsd.gsd": the name in the folder also.
std::string name_in_also(const std::string& format);

// Writes each format whole and replaces a former file of that name. The run's folder holds a trajectory with
// a frame. watcher: told the format and the share of all that is done; false stops, and what is not whole is
// left out. Returns "also/vtk, also/gsd.gsd", those that were written; a format that is not written keeps its
// former file. Throws RunError or UserError when one cannot be written.
std::string write_also(const std::filesystem::path& run, const Scene& scene,
                       const std::function<bool(const std::string& format, double done)>& watcher);

}  // namespace grainreel
