// A run that the command line ends earlier than its scene does goes without what would begin only after that.
#pragma once

#include "engine/scene/keys/document.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Whether `run.duration` is the command line's.
bool ends_early(const Document& document);

// Leaves out stages of the drive, feeds and an outlet that come too late. The run's keys are read; the film's
// come later, and leave out what is theirs.
void shorten(const Document& document, Scene& scene);

// "2 captions" in the scene's one note of what is left out, where there are some.
void leave_out(Scene& scene, std::size_t count, const char* one, const char* many);

}  // namespace grainreel
