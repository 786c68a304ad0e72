// Draws one moment of a finished run as a PNG file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run/folder/listener.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/stored_shots.hpp"

namespace grainreel {

// Draws the run at what.at (s), as its film would show that moment. When the moment was not kept and cannot
// be brought back, it draws the nearest kept moment, with a warning. Returns the file; none when the listener
// asked to stop. Throws UserError, with nothing written, when the run has no such moment, or when the file
// exists and may not be replaced, or cannot be written.
std::optional<std::filesystem::path> draw_still(const FilmRequest& request, const RenderRequest& what,
                                                Listener& listener, StoredShots& source);

// Throws UserError where --out names no PNG file, or one that exists and may not be replaced.
void check_still(const FilmRequest& request, const RenderRequest& what);

// Writes a time (s) for a file's name: "1.250", with more digits when the time needs them.
std::string seconds_in_names(double time);

}  // namespace grainreel
