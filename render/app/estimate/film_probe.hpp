// How long a frame of a scene's film takes, found by making a few.
#pragma once

#include <optional>
#include <string>

#include "engine/frame.hpp"
#include "render/app/estimate/engine_cost.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// s of processor time that a film takes besides its frames: the context, the first frame, the poster.
constexpr double film_setup_seconds = 0.2;

// Draws and encodes some frames of the scene's grains, stacked as the bed will lie, in a folder that is gone
// afterwards. None when that is not possible here (no OpenGL, no codec, no room),
// and of beds of more than 200,000 grains.
std::optional<FilmSpeed> probe_film(const FilmedScene& scene, const ThreadPlan& threads);

// The scene's grains in a stack from the floor up, as loose as a shaken bed. Exposed for tests.
Frame stacked_bed(const FilmedScene& scene);

}  // namespace grainreel
