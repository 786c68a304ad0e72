// One moment of a finished run as a PNG file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run/folder/listener.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/revisited_run.hpp"

namespace grainreel {

// Draws the run at what.at (s), as its film would show that moment; where it was not kept and cannot be
// brought back, the kept moment nearest to it, with a warning. Gives the file; none when the listener asked
// to stop. Throws UserError, with nothing written, when the run has no such moment, or the file is there
// already (and may not be replaced) or cannot be.
std::optional<std::filesystem::path> draw_still(const FilmRequest& request, const RenderRequest& what,
                                                RunListener& listener, RevisitedRun& source);

// "1.250", and as many digits as a time (s) needs that has more of them.
std::string seconds_in_names(double time);

}  // namespace grainreel
