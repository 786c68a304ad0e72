// Chapters of the scene whose keys are bound to a struct each: they list them for the table of all, and write
// them. Reading is in reader_parts.hpp. Internal.
#pragma once

#include "engine/plan/plan.hpp"
#include "engine/scene/keys/key_parts.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

void list_drive(keys::Keys& all);
void write_drive(SceneText& out, const Scene& scene);

void list_start(keys::Keys& all);
void write_start(SceneText& out, const Scene& scene);

// [run] and [output]; with what the plan chose where the scene leaves it open.
void list_run(keys::Keys& all);
void write_run(SceneText& out, const Scene& scene, const Plan& plan);

}  // namespace grainreel
