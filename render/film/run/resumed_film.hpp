// The film of a run that goes on in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "engine/plan/plan.hpp"
#include "engine/run/resume/resume_point.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Whether the run's folder has a film, or the beginning of one.
bool has_film(const FilmedScene& scene, const std::filesystem::path& run);

// A film is drawn again: from the kept moments of its pictures up to the checkpoint, and from there on as the
// run goes. So a film whose pictures show more than a moment, or one whose moments were not kept, lets the
// run go on from its beginning. The scene and the plan must outlive what is returned.
FramesReach reach_of_film(const FilmedScene& scene, const Plan& plan);

// A caption that says from `time` (s of simulated time) on what has changed; the engine is told. Nothing
// without a text.
void add_caption_of_change(FilmedScene& scene, double time, const std::string& text);

}  // namespace grainreel
