// How far a run has come, in words for people and in JSON for programs.
#pragma once

#include <string>

#include "engine/run/folder/listener.hpp"

namespace grainreel {

std::string to_string(Progress::Stage stage);

// "vibrating  3.20 of 10.00 s   12.4 M particle-steps/s   frame 96 of 300   1 min 05 s left", cut to `width`
// columns from its end, whole parts at a time.
std::string progress_line(const Progress& progress, int width);

// One object, one line, without the line's end.
std::string progress_json(const Progress& progress);

}  // namespace grainreel
