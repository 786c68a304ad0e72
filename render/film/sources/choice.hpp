// Which moments of a run that lies on disk are drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/sources/film_request.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Those from `from` to `to`, every so many, and of frames at one phase of the drive only those at which the
// bed looks alike. Throws UserError when there is none.
std::vector<Frame> chosen_moments(const RenderRequest& what, const FrameArchive& run);

// Moments at one phase of the drive that lie whole multiples of `periods` behind the first: a bed
// that repeats itself after so many looks alike there. Others are left as they are.
std::vector<Frame> alike(const std::vector<Frame>& moments, int periods);

// A line for each segment of the scene's film whose pictures are to show more than a moment, where they
// cannot.
std::vector<std::string> single_moment_warnings(const FilmedScene& scene, const std::string& why);

// Without means and exposures.
std::vector<FilmSegment> of_single_moments(std::vector<FilmSegment> segments);

// What is to be said of a run whose bed repeats itself only every so many periods, where the scene leaves it
// open.
std::optional<std::string> periods_warning(const FilmedScene& scene, const FrameArchive& run);

}  // namespace grainreel
