// The keys of [[drive.stage]].
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

}  // namespace grainreel
