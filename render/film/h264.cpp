#include "render/film/h264.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

void set_picture(AVCodecContext& codec, const H264Settings& settings) {
    codec.width = settings.width;
    codec.height = settings.height;
    codec.time_base = av_inv_q(settings.rate);
    codec.framerate = settings.rate;
    codec.sample_aspect_ratio = {1, 1};
    codec.pix_fmt = AV_PIX_FMT_YUV420P;  // browsers refuse anything finer
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
    codec.colorspace = AVCOL_SPC_BT709;
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

// What a kill loses is what the encoder holds back: look-ahead, B-frames twice (x264 looks ahead for them in
// a thread of its own) and a frame a thread. This is about a second; slow films hold nothing back.
void set_groups(AVCodecContext& codec, AvOptions& options, const H264Settings& settings) {
    const double rate = av_q2d(settings.rate);
    codec.gop_size = std::max(1, static_cast<int>(rate));
    codec.flags |= AV_CODEC_FLAG_CLOSED_GOP | AV_CODEC_FLAG_GLOBAL_HEADER;
    if (rate < 15) {
        codec.max_b_frames = 0;
        options.set("rc-lookahead", "0");
        options.set("x264-params", "sync-lookahead=0");
    } else {
        if (settings.preset != "ultrafast")
            codec.max_b_frames = 3;  // the slowest presets would take up to 16
        options.set("rc-lookahead", std::to_string(std::min(10, static_cast<int>(rate / 3))));
    }
}

// x264 itself prints to the terminal when it does not know a preset, past FFmpeg's log.
void check_preset(const std::string& preset) {
    static const std::vector<std::string> presets{"ultrafast", "superfast", "veryfast", "faster",
                                                  "fast",      "medium",    "slow",     "slower",
                                                  "veryslow",  "placebo"};
    if (std::find(presets.begin(), presets.end(), preset) == presets.end())
        throw RunError(
            fmt::format("film: x264 has no preset \"{}\"; take one of {}", preset, fmt::join(presets, ", ")));
}

// OpenH264 knows no constant quality: bits a pixel that halve for every 6 of crf, 0.1 at crf 23.
std::int64_t bit_rate(const H264Settings& settings) {
    const double pixels = static_cast<double>(settings.width) * settings.height * av_q2d(settings.rate);
    return std::llround(0.1 * pixels * std::exp2((23 - settings.crf) / 6.0));
}

}  // namespace

const std::vector<std::string>& known_h264_encoders() {
    static const std::vector<std::string> names{"libx264", "libopenh264"};
    return names;
}

CodecPtr open_h264(const H264Settings& settings, const std::vector<std::string>& names) {
    const AVCodec* encoder = nullptr;
    for (const std::string& name : names)
        if (!encoder) encoder = avcodec_find_encoder_by_name(name.c_str());
    if (!encoder)
        throw RunError(
            fmt::format("film: this machine's FFmpeg has no H.264 encoder ({}); install FFmpeg libraries "
                        "built with libx264 (Debian: libavcodec59), or ask for --no-film --frames",
                        fmt::join(names, ", ")));
    CodecPtr codec(avcodec_alloc_context3(encoder));
    if (!codec) throw RunError("film: no memory for the encoder");
    AvOptions options;
    set_picture(*codec, settings);
    codec->thread_count = settings.threads;
    if (std::string(encoder->name) == "libx264") {
        check_preset(settings.preset);
        set_groups(*codec, options, settings);
        options.set("crf", std::to_string(settings.crf));
        options.set("preset", settings.preset);
    } else {
        codec->gop_size = std::max(1, static_cast<int>(av_q2d(settings.rate)));
        codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        codec->bit_rate = bit_rate(settings);
    }
    const int code = avcodec_open2(codec.get(), encoder, options.get());
    if (code < 0)
        throw RunError(fmt::format("film: {} refused size {}x{}, {:g} frames/s, preset {}, crf {}: {}",
                                   encoder->name, settings.width, settings.height, av_q2d(settings.rate),
                                   settings.preset, settings.crf, ffmpeg_error(code)));
    return codec;
}

std::string describe_h264(const AVCodecContext& codec, const H264Settings& settings) {
    const std::string quality = codec.bit_rate > 0 ? fmt::format("{} kbit/s", codec.bit_rate / 1000)
                                                   : fmt::format("crf {}, {}", settings.crf, settings.preset);
    return fmt::format("{} ({}), {}, {} thread{}", codec.codec->name, LIBAVCODEC_IDENT, quality,
                       settings.threads, settings.threads == 1 ? "" : "s");
}

}  // namespace grainreel
