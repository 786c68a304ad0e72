// The keys of [[drive.stage]], and what is left out of a run that the command line ends early.
#pragma once

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

void list_stages(keys::Keys& all);
// Reads and writes the stages, after the other keys of [drive]. Throws UserError.
void read_stages(Document& document, Scene& scene);
void write_stages(SceneText& out, const Scene& scene);

// Removes the last stages that do not begin, or do not reach what they change to, before the run ends.
// Returns how many it removed.
std::size_t shorten_stages(Scene& scene);
// Throws UserError where stages do not fit each other, the ramp or the run.
void check_stages(const Scene& scene);

// The command line may end a run earlier than its scene does. Then the parts of the scene that would begin
// after this end are left out.

// Whether `run.duration` comes from the command line.
bool ends_early(const Document& document);

// Leaves out stages of the drive, feeds and an outlet that come too late. The run's keys must have been read.
// The film's keys are read later, and their reader leaves out its own parts.
void shorten(const Document& document, Scene& scene);

// The scene has one note that lists what is left out. Adds to it, for example, "2 captions". Does nothing for
// a count of 0.
void leave_out(Scene& scene, std::size_t count, const char* one, const char* many);

}  // namespace grainreel
