// Pictures of one run for another program, which asks for them one after the other: `render --asked`, which
// the Python module starts. So the run is opened once, and the OpenGL context is made once.
//
// First the folder of the run and its last moment are written to stdout, as a JSON object in a line:
// {"run": "output/mine", "last": 2.0}. Then each line of stdin asks for a picture:
//   {"at": 0.1}                       s; or {"frame": 3}, or {"cycle": 40, "phase": 0.5}; else the last one
//   {"set": ["film.size=640x480"]}    keys of its film, as after --set
//   {"colour": {"title": "age (s)", "range": [0, 2], "map": "viridis", "logarithmic": false,
//               "id": [0, 4], "value": [0.1, null]}}   own values; without `id` of all grains, by rising id
// The answer is a line and then the picture's bytes, rows from the top, 4 bytes a pixel:
//   {"width": 640, "height": 480, "transparent": false, "time": 0.1, "notes": ["a warning"]}
// A mistake is a line without a picture: {"error": "..."}.
#pragma once

#include "render/app/messages/reporter.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

// Answers until stdin ends. what.run: the folder of the run. Throws UserError when it cannot be read, or when
// its film has a mistake. Returns the exit status.
int draw_asked_pictures(const FilmRequest& film, const RenderRequest& what, const Reporter& reporter);

}  // namespace grainreel
