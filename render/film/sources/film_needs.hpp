// What a film shows and a run on disk lacks. The film is refused, with advice, or it does without, with a
// line for the user.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/run/stored/stored_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What the film shows that no other engine tells, with what to do without it, for a message; none if it shows
// nothing of the kind.
std::optional<std::string> lacking_elsewhere(const FilmedScene& scene);

// Fits the film to what the run has, and returns a line for each thing that is left out of it. Throws
// UserError for what would make its pictures wrong: orientations, contacts, columns of measures and wear of
// walls that it shows and that cannot be had.
std::vector<std::string> do_without(FilmedScene& scene, const StoredRun& run);

}  // namespace grainreel
