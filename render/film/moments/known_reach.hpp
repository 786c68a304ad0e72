// How high the grains of a finished run got.
#pragma once

#include <optional>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// m above the floor's rest position: below it are 99 of 100 grains, whole, in every frame. Of a long
// record of many grains evenly spread frames are read. Damaged frames do not count. Empty without grains.
std::optional<double> known_reach(const FrameArchive& archive);

// The same of one frame.
std::optional<double> reach_of(const Frame& frame);

}  // namespace grainreel
