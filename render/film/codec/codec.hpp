// The formats of films: the encoder, the container and the pixels of each. codec.cpp has a table with one
// line for each format, and below it the set-up of each encoder. A new format begins here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/film/codec/ffmpeg.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The highest film.quality (crf of x264) at which every small digit on a frame can be read. Measured on 251
// frames of the moving wedge as the share of digits that look more like another digit than like themselves.
// At 640x360 it is 0 at quality 24, 0.05 % at 26, 0.2 % at 28 and 15 % at 34; at 1280x720 it is 0 at 24, 0.01
// % at 26, 0.05 % at 28 and 2 % at 32.
constexpr int least_legible = 24;

struct CodecSettings {
    int width = 0, height = 0;  // pixels; even numbers where the chroma is halved
    AVRational rate{30, 1};     // frames a second
    int quality = 20;           // as film.quality
    std::string preset = "veryfast";
    int threads = 1;  // the bits may depend on it, so it is never left to the machine
    bool alpha = false;
    // 0: a single pass of constant quality. 1 and 2: two passes over the same pictures. The first pass notes
    // what the second one needs to reach `bit_rate`; `log` is the name of the file with these notes or, for
    // encoders without such a file, their text.
    int pass = 0;
    std::int64_t bit_rate = 0;  // bits/s; 0: constant quality
    std::string log;
};

// An encoder of FFmpeg and the function that sets it up for films. That function returns the settings in
// words: "crf 20, veryfast".
struct EncoderSetup {
    const char* name;
    std::string (*set_up)(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings);
};

struct FilmContainer {
    const char* muxer;
    std::vector<std::pair<const char*, const char*>> growing;  // options of the file while pictures are added
    // Options of the copy that replaces the film when it is complete; empty: the film stays as it was
    // written.
    std::vector<std::pair<const char*, const char*>> complete;
};

struct Codec {
    const char* words;      // "H.264 in MP4"
    const char* extension;  // ending of the file's name
    const char* standard;   // the standard that the encoders follow: "H.264"
    FilmContainer container;
    std::vector<EncoderSetup> encoders;  // best first
    AVPixelFormat pixels;
    AVPixelFormat pixels_with_alpha;  // AV_PIX_FMT_NONE where no alpha can be kept
    // Whether the first of two passes makes a film too; otherwise it only gathers figures for the second.
    bool film_is_first_pass = false;
};

// The codec of a format. The format png has none, since it makes no single file.
const Codec& codec_of(FilmFormat format);
// Codecs for the exact copy ("spool") of a film that is encoded only when all its pictures are there. The
// first stores the pixels that H.264 and VP9 take, the second the pictures themselves.
const Codec& spool_of_yuv();
const Codec& spool_of_rgb();

struct OpenCodec {
    CodecPtr context;
    std::string description;  // "libx264 (Lavc59.37.100), crf 20, veryfast, 2 threads"
};

// Opens the first encoder that FFmpeg has. Where the pixels are Y'CbCr the film is tagged as BT.709 in
// limited range. `context->time_base` is one frame. Throws RunError when FFmpeg has none of the encoders or
// refuses the settings.
OpenCodec open_codec(const Codec& codec, const CodecSettings& settings);

// The functions that set up FFmpeg's encoders for films. All of them ask for a key frame at least every half
// second and let the encoder hold back few frames, so that a kill costs two seconds of film at most. They
// take threads and quality from the settings.

using SetUp = std::string(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings);
SetUp set_up_x264, set_up_x264_lossless, set_up_openh264, set_up_vp9, set_up_svt_av1, set_up_aom_av1,
    set_up_ffv1, set_up_gif, set_up_raw;

}  // namespace grainreel
