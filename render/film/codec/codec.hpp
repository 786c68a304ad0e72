// What each format of film is: its encoder, its container, its pixels. A table has one line for each format
// (codec.cpp), and below it how each encoder is set up. A new format begins here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/film/codec/ffmpeg.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The highest film.quality (crf of x264) at which every small digit on a frame reads right: of 251 frames of
// the wedge in motion at 640x360, in windows of a digit each, none looked more like another digit than like
// its own at 24, 0.05 % did at 26, 0.2 % at 28 and 15 % at 34; at 1280x720 none, 0.01 %, 0.05 % and 2 % (at
// 32).
constexpr int least_legible = 24;

struct CodecSettings {
    int width = 0, height = 0;  // pixels; even where the chroma is halved
    AVRational rate{30, 1};     // frames a second
    int quality = 20;           // as film.quality
    std::string preset = "veryfast";
    int threads = 1;  // the bits may depend on it, so it is never left to the machine
    bool alpha = false;
    // Two passes, both of one clip: the first notes in the file (or, empty, the text) `log` what the second
    // needs to reach `bit_rate`. Pass 0: one pass, of constant quality.
    int pass = 0;
    std::int64_t bit_rate = 0;  // bits/s; 0: constant quality
    std::string log;
};

// An encoder of FFmpeg, and how films want it. Returns the settings in words: "crf 20, veryfast".
struct EncoderSetup {
    const char* name;
    std::string (*set_up)(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings);
};

struct FilmContainer {
    const char* muxer;
    std::vector<std::pair<const char*, const char*>> growing;  // options while pictures come
    // Options of the copy that takes the film's place when it is complete; empty: the film stays as it grew.
    std::vector<std::pair<const char*, const char*>> complete;
};

struct Codec {
    const char* words;      // "H.264 in MP4"
    const char* extension;  // of the file's name
    const char* standard;   // what an encoder has to encode: "H.264"
    FilmContainer container;
    std::vector<EncoderSetup> encoders;  // best first
    AVPixelFormat pixels;
    AVPixelFormat pixels_with_alpha;  // AV_PIX_FMT_NONE: keeps no alpha
    // Whether the first of two passes is a film by itself; else it yields nothing but its findings.
    bool film_is_first_pass = false;
};

// The codec of any format but png, which has no file of its own.
const Codec& codec_of(FilmFormat format);
// The exact copies of a film that is encoded when it is complete: as H.264 and VP9 would be given it, and of
// the pictures themselves.
const Codec& spool_of_yuv();
const Codec& spool_of_rgb();

struct OpenCodec {
    CodecPtr context;
    std::string description;  // "libx264 (Lavc59.37.100), crf 20, veryfast, 2 threads"
};

// BT.709 and limited range tagged where the pixels are Y'CbCr; `context->time_base` is one frame. Throws
// RunError when FFmpeg has none of the encoders, or the settings are refused.
OpenCodec open_codec(const Codec& codec, const CodecSettings& settings);

// How films want each encoder of FFmpeg. What they have in common: a key frame every half second at least and
// little held back, so that a kill costs two seconds of film at most; threads as told; quality by
// film.quality.

using SetUp = std::string(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings);
SetUp set_up_x264, set_up_x264_lossless, set_up_openh264, set_up_vp9, set_up_svt_av1, set_up_aom_av1,
    set_up_ffv1, set_up_gif, set_up_raw;

}  // namespace grainreel
