// How films want each encoder of FFmpeg. What they have in common: a key frame every half second at least and
// little held back, so that a kill costs two seconds of film at most; threads as told; quality by
// film.quality.
#pragma once

#include <string>

#include "render/film/codec/codec.hpp"

namespace grainreel {

using SetUp = std::string(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings);
SetUp set_up_x264, set_up_x264_lossless, set_up_openh264, set_up_vp9, set_up_svt_av1, set_up_aom_av1,
    set_up_ffv1, set_up_gif, set_up_raw;

}  // namespace grainreel
