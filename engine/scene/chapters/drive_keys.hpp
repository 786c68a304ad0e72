// The keys of [[drive.stage]], and what a run leaves out that the command line ends early.
#pragma once

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

void list_stages(keys::Keys& all);
// After all else of [drive]. Throws UserError.
void read_stages(Document& document, Scene& scene);
void write_stages(SceneText& out, const Scene& scene);

// Takes out the last stages that do not begin, or do not come to what they change to, before the run ends.
// Returns how many.
std::size_t shorten_stages(Scene& scene);
// Throws UserError where stages do not fit each other, the ramp or the run.
void check_stages(const Scene& scene);

// A run that the command line ends earlier than its scene does goes without what would begin only after that.

// Whether `run.duration` is the command line's.
bool ends_early(const Document& document);

// Leaves out stages of the drive, feeds and an outlet that come too late. The run's keys are read; the film's
// come later, and leave out what is theirs.
void shorten(const Document& document, Scene& scene);

// "2 captions" in the scene's one note of what is left out, where there are some.
void leave_out(Scene& scene, std::size_t count, const char* one, const char* many);

}  // namespace grainreel
