// One frame of a finished run as a PNG file.
#pragma once

#include <filesystem>

#include "render/run/film_request.hpp"
#include "render/run/frames/recorded_run.hpp"
#include "render/run/listener.hpp"

namespace grainreel {

// Draws the frame nearest to `at` (s); gives the file. Throws UserError, with nothing written, when the file
// is there already (and may not be replaced) or cannot be.
std::filesystem::path draw_still(const FilmRequest& request, double at, RunListener& listener,
                                 const RecordedRun& run);

}  // namespace grainreel
