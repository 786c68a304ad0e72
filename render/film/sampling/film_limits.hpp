// What can be said of a film's file before it is made: its size, its limits, and warnings.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Bytes of a film of so many frames, estimated from pixels, format and quality, and no more than its cap. It
// is good to a factor of two or three.
double estimated_film_size(const Film& film, std::int64_t frames);

// At 30 frames a second such a film plays for four days; its schedule takes 160 MB.
constexpr std::int64_t most_frames = 10'000'000;
// Limit for the earlier moments over which pictures are exposed or averaged; their lists take 2 GB at worst.
constexpr std::int64_t most_moments = 20'000'000;

// Throws UserError when the film would have more of either. The error names the segment that makes most of
// them.
void check_schedule(const FilmedScene& scene, const std::vector<SegmentCount>& counts);

// Throws UserError when film.max_size leaves so few bits for a pixel that no film could be read.
void check_max_size(const FilmedScene& scene, std::int64_t frames);

// Throws UserError when a limit of the process (`ulimit -v`) leaves too few addresses for a film's pictures.
void check_addresses(const Film& film);

// Warnings: words that the picture has no room for, letters that no font has, and films for a journal that
// journals do not take.
std::vector<std::string> film_warnings(const FilmedScene& scene, std::int64_t frames);

}  // namespace grainreel
