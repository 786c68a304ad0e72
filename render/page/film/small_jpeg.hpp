// A picture small enough for a page to bring it with it.
#pragma once

#include <cstdint>
#include <vector>

#include "render/film/codec/ffmpeg.hpp"

namespace grainreel {

// A JPEG, 960 pixels wide at most, of a frame that this decoder gave. Empty where none can be made. Throws
// RunError.
std::vector<std::uint8_t> small_jpeg(const AVCodecContext& decoder, AVFrame& frame);

}  // namespace grainreel
