// The H.264 encoder of this machine's FFmpeg, set up for films that survive a kill.
#pragma once

#include <string>
#include <vector>

#include "render/film/ffmpeg_handles.hpp"

namespace grainreel {

struct H264Settings {
    int width = 0, height = 0;  // pixels, even
    AVRational rate{30, 1};     // frames a second
    int crf = 20;
    std::string preset = "veryfast";
    int threads = 1;  // x264's bits depend on it, so it is never left to the machine
};

// Encoders we know how to set up, best first.
const std::vector<std::string>& known_h264_encoders();

// The encoder opened, BT.709 and limited range tagged, closed groups of a second at most. `codec->time_base`
// is one frame. Throws RunError when FFmpeg has none of `names`, or the settings are refused.
CodecPtr open_h264(const H264Settings& settings,
                   const std::vector<std::string>& names = known_h264_encoders());

// "libx264 (Lavc59.37.100), crf 20, veryfast, 2 threads"
std::string describe_h264(const AVCodecContext& codec, const H264Settings& settings);

}  // namespace grainreel
