// One frame of a finished run as a PNG file.
#pragma once

#include <filesystem>

#include "render/run/film_request.hpp"
#include "render/run/frames/frame_source.hpp"
#include "render/run/listener.hpp"

namespace grainreel {

// Draws the frame nearest to `at` (s) of a source with an archive; gives the file. Throws UserError, with
// nothing written, when the file is there already (and may not be replaced) or cannot be.
std::filesystem::path draw_still(const FilmRequest& request, double at, RunListener& listener,
                                 const FrameSource& source);

}  // namespace grainreel
