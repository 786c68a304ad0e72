// A run in formats of other programs ([output] also): RUN/also/vtk/, RUN/also/gsd.gsd. They are made from the
// run's own files after the run has stopped, at its end or before, so they do not slow the run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/scene/scene.hpp"

namespace grainreel {

// Throws UserError, with the place in the scene, if runs of this scene cannot be exported to a format.
void check_also(const Scene& scene);

// The name of a format in the folder `also`: "vtk", "gsd.gsd".
std::string name_in_also(const std::string& format);

// Writes each format whole and replaces a former file of that name. The run's folder must hold a trajectory
// with a frame. The watcher gets the format and the share of all work that is done. If it returns false, the
// export stops, and unfinished files are left out. Returns the names that were written, "also/vtk,
// also/gsd.gsd". A format that is not written keeps its former file. Throws RunError or UserError when one
// cannot be written.
std::string write_also(const std::filesystem::path& run, const Scene& scene,
                       const std::function<bool(const std::string& format, double done)>& watcher);

}  // namespace grainreel
