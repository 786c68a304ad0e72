#include "render/film/codec/codec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"

namespace grainreel {

namespace {

// A fragment or cluster is written when it is complete. It holds half a second of film at most, so that no
// more than that waits in memory. Its header has some hundred bytes.
const FilmContainer mp4{
    "mp4",
    {{"movflags", "frag_keyframe+empty_moov+default_base_moof"}, {"frag_duration", "500000"}},
    {{"movflags", "faststart"}}};
const FilmContainer webm{"webm", {{"cluster_time_limit", "500"}}, {{"cues_to_front", "1"}}};
const FilmContainer matroska{"matroska", {{"cluster_time_limit", "500"}}, {}};
const FilmContainer gif{"gif", {{"loop", "0"}}, {}};
const FilmContainer y4m{"yuv4mpegpipe", {}, {}};

constexpr AVPixelFormat yuv = AV_PIX_FMT_YUV420P;  // browsers refuse finer chroma
constexpr AVPixelFormat no_alpha = AV_PIX_FMT_NONE;

const Codec h264{
    "H.264 in MP4", "mp4", "H.264", mp4, {{"libx264", set_up_x264}, {"libopenh264", set_up_openh264}}, yuv,
    no_alpha,       true};
const Codec vp9{"VP9 in WebM", "webm", "VP9", webm, {{"libvpx-vp9", set_up_vp9}}, yuv, no_alpha};
// AV1 is stored in MP4, not WebM: Safari plays it in MP4 only, the other browsers play both.
const Codec av1{
    "AV1 in MP4", "mp4",   "AV1", mp4, {{"libsvtav1", set_up_svt_av1}, {"libaom-av1", set_up_aom_av1}},
    yuv,          no_alpha};
const Codec ffv1{"FFV1 in Matroska",      "mkv",           "FFV1",         matroska,
                 {{"ffv1", set_up_ffv1}}, AV_PIX_FMT_BGR0, AV_PIX_FMT_BGRA};
const Codec gif_palette{"GIF", "gif", "GIF", gif, {{"gif", set_up_gif}}, AV_PIX_FMT_PAL8, no_alpha};
const Codec raw{"raw Y4M", "y4m", "raw", y4m, {{"wrapped_avframe", set_up_raw}}, yuv, no_alpha};
const Codec yuv_spool{"a spool of the film",
                      "spool.mkv",
                      "lossless",
                      matroska,
                      {{"libx264", set_up_x264_lossless}, {"ffv1", set_up_ffv1}},
                      yuv,
                      no_alpha};

CodecPtr allocate(const AVCodec* encoder) {
    CodecPtr codec(avcodec_alloc_context3(encoder));
    if (!codec) throw RunError("film: no memory for the encoder");
    return codec;
}

bool is_rgb(AVPixelFormat pixels) {
    return pixels == AV_PIX_FMT_BGR0 || pixels == AV_PIX_FMT_BGRA || pixels == AV_PIX_FMT_PAL8;
}

void set_picture(AVCodecContext& context, const Codec& codec, const CodecSettings& settings) {
    context.width = settings.width;
    context.height = settings.height;
    context.time_base = av_inv_q(settings.rate);
    context.framerate = settings.rate;
    context.sample_aspect_ratio = {1, 1};
    context.pix_fmt = settings.alpha ? codec.pixels_with_alpha : codec.pixels;
    context.thread_count = settings.threads;
    context.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    context.color_primaries = AVCOL_PRI_BT709;
    if (is_rgb(context.pix_fmt)) {
        context.color_trc = AVCOL_TRC_IEC61966_2_1;
        context.colorspace = AVCOL_SPC_RGB;
        context.color_range = AVCOL_RANGE_JPEG;
        return;
    }
    context.color_trc = AVCOL_TRC_BT709;
    context.colorspace = AVCOL_SPC_BT709;
    context.color_range = AVCOL_RANGE_MPEG;
    context.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

[[noreturn]] void no_encoder(const Codec& codec) {
    std::vector<std::string> names;
    for (const EncoderSetup& encoder : codec.encoders) names.emplace_back(encoder.name);
    throw RunError(
        "film: this machine's FFmpeg has no {} encoder ({}); install FFmpeg libraries built with {} "
        "(Debian: libavcodec59), choose another --format, or ask for --no-film --frames",
        codec.standard, fmt::join(names, ", "), names.front());
}

}  // namespace

const Codec& codec_of(FilmFormat format) {
    GRAINREEL_CHECK(format != FilmFormat::png);
    switch (format) {
        case FilmFormat::mp4:
        case FilmFormat::png:
            return h264;
        case FilmFormat::webm:
            return vp9;
        case FilmFormat::av1:
            return av1;
        case FilmFormat::gif:
            return gif_palette;
        case FilmFormat::ffv1:
            return ffv1;
        case FilmFormat::y4m:
            break;
    }
    return raw;
}

const Codec& spool_of_yuv() {
    return yuv_spool;
}

const Codec& spool_of_rgb() {
    static const Codec spool = [] {
        Codec codec = ffv1;
        codec.words = yuv_spool.words;
        codec.extension = yuv_spool.extension;
        return codec;
    }();
    return spool;
}

OpenCodec open_codec(const Codec& codec, const CodecSettings& settings) {
    quiet_ffmpeg();
    for (const EncoderSetup& setup : codec.encoders) {
        const AVCodec* encoder = avcodec_find_encoder_by_name(setup.name);
        if (!encoder) continue;
        OpenCodec open{allocate(encoder), ""};
        AvOptions options;
        set_picture(*open.context, codec, settings);
        const std::string words = setup.set_up(*open.context, options, settings);
        const int code = avcodec_open2(open.context.get(), encoder, options.get());
        if (code < 0)
            throw RunError("film: {} refused size {}x{}, {:g} frames/s, {}: {}", setup.name, settings.width,
                           settings.height, av_q2d(settings.rate), words, ffmpeg_error(code));
        const unsigned version = avcodec_version();
        open.description = fmt::format("{} (Lavc{}.{}.{}), {}{} thread{}", setup.name,
                                       AV_VERSION_MAJOR(version), AV_VERSION_MINOR(version),
                                       AV_VERSION_MICRO(version), words.empty() ? "" : words + ", ",
                                       settings.threads, settings.threads == 1 ? "" : "s");
        return open;
    }
    no_encoder(codec);
}

namespace {

// Key frames are half a second apart at most, because seeking in a film takes as long as decoding the frames
// since the last key frame.
int key_frame_distance(const CodecSettings& settings) {
    return std::max(1, static_cast<int>(av_q2d(settings.rate) / 2));
}

// A killed run loses mainly those frames of its film that the encoder holds back: a third of a second at
// most.
int look_ahead(const CodecSettings& settings) {
    return std::min(10, static_cast<int>(av_q2d(settings.rate) / 3));
}

constexpr std::array<const char*, 10> presets{"ultrafast", "superfast", "veryfast", "faster",   "fast",
                                              "medium",    "slow",      "slower",   "veryslow", "placebo"};

// Finds the preset among the known ones, because x264 would complain of an unknown preset on the terminal
// itself, past FFmpeg's log.
std::size_t preset_number(const std::string& preset) {
    if (const auto place = place_in(presets, preset)) return *place;
    throw RunError("film: x264 has no preset \"{}\"; take one of {}", preset, fmt::join(presets, ", "));
}

// The crf of a codec whose scale runs from 0 to 63. `at_23` is the one that looks like x264's crf 23; steps
// are 1.5 times as large, since the scale is longer.
int crf_alike(int quality, double at_23) {
    return std::clamp(static_cast<int>(std::lround(at_23 + 1.5 * (quality - 23))), 1, 63);
}

// Sets constant quality, or the rate that two passes are to reach.
std::string set_quality(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings, int crf) {
    codec.bit_rate = settings.bit_rate;
    if (settings.bit_rate > 0) return fmt::format("two passes, {} kbit/s", settings.bit_rate / 1000);
    options.set("crf", std::to_string(crf));
    return fmt::format("crf {}", crf);
}

// x264 164's look-ahead (mbtree) reads memory that nobody wrote when it uses AVX-512 and the width is no
// multiple of its registers. Films then differ from run to run. With AVX2 they do not differ, and they equal
// the films of machines without AVX-512.
std::string deterministic_x264() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return "asm=AVX2,FMA3,BMI2,LZCNT";
#endif
    return "";
}

void set_pass(AVCodecContext& codec, const CodecSettings& settings) {
    if (settings.pass == 1) codec.flags |= AV_CODEC_FLAG_PASS1;
    if (settings.pass == 2) codec.flags |= AV_CODEC_FLAG_PASS2;
}

}  // namespace

std::string set_up_x264(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings) {
    preset_number(settings.preset);
    codec.gop_size = key_frame_distance(settings);
    codec.flags |= AV_CODEC_FLAG_CLOSED_GOP;
    std::string parameters = deterministic_x264();
    const auto add = [&parameters](const char* more) {
        if (!parameters.empty()) parameters += ':';
        parameters += more;
    };
    // With the default preset, motion is searched to half a sample only. This takes 28 % less work and makes
    // files 6 % larger. The quality stays about the same: the SSIM of the default film is 27.9 dB instead of
    // 28.5 dB, and that of films locked to one phase is 24.6 dB either way.
    if (settings.preset == "veryfast") add("subme=1");
    if (av_q2d(settings.rate) < 15) {
        // At such low rates no frame is held back. x264's search for B-frames in a thread of its own would do
        // that too, so it is off.
        codec.max_b_frames = 0;
        options.set("rc-lookahead", "0");
        add("sync-lookahead=0");
    } else {
        if (settings.preset != "ultrafast")
            codec.max_b_frames = 3;  // the slowest presets would take up to 16
        options.set("rc-lookahead", std::to_string(look_ahead(settings)));
    }
    if (!parameters.empty()) options.set("x264-params", parameters);
    set_pass(codec, settings);
    if (settings.pass > 0) options.set("stats", settings.log);
    if (settings.pass == 1) options.set("fastfirstpass", "0");  // the first pass is a complete film itself
    options.set("preset", settings.preset);
    return set_quality(codec, options, settings, settings.quality) + ", " + settings.preset;
}

std::string set_up_x264_lossless(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings) {
    codec.gop_size = key_frame_distance(settings);
    options.set("qp", "0");
    options.set("preset", "ultrafast");
    return "lossless";
}

// OpenH264 has no constant quality, so it gets a rate: 0.1 bits a pixel at crf 23, and half as many for a crf
// that is higher by 6.
std::string set_up_openh264(AVCodecContext& codec, AvOptions&, const CodecSettings& settings) {
    const double pixels = static_cast<double>(settings.width) * settings.height * av_q2d(settings.rate);
    codec.gop_size = key_frame_distance(settings);
    codec.bit_rate = settings.bit_rate > 0
                         ? settings.bit_rate
                         : std::llround(0.1 * pixels * std::exp2((23 - settings.quality) / 6.0));
    return fmt::format("{} kbit/s", codec.bit_rate / 1000);
}

std::string set_up_vp9(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings) {
    constexpr std::array<const char*, presets.size()> cpu_used{"5", "5", "5", "4", "4",
                                                               "3", "2", "1", "0", "0"};
    const char* speed = cpu_used[preset_number(settings.preset)];
    codec.gop_size = key_frame_distance(settings);
    options.set("deadline", "good");
    options.set("cpu-used", speed);
    options.set("row-mt", "1");
    // The number of tiles depends on the width alone. If it depended on the threads, the bits would too.
    options.set("tile-columns", settings.width >= 1024 ? "2" : settings.width >= 512 ? "1" : "0");
    options.set("lag-in-frames", std::to_string(look_ahead(settings)));
    set_pass(codec, settings);
    if (settings.pass == 2) codec.stats_in = av_strdup(settings.log.c_str());
    return fmt::format("{}, cpu-used {}",
                       set_quality(codec, options, settings, crf_alike(settings.quality, 33)), speed);
}

std::string set_up_svt_av1(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings) {
    constexpr std::array<const char*, presets.size()> numbers{"12", "11", "10", "9", "8",
                                                              "7",  "6",  "5",  "4", "3"};
    const char* preset = numbers[preset_number(settings.preset)];
    codec.gop_size = key_frame_distance(settings);
    options.set("preset", preset);
    // Mini groups have 8 frames instead of 16 or 32: a kill loses half a second less, for 2 % more bytes.
    options.set("svtav1-params", fmt::format("lp={}:lookahead={}:hierarchical-levels=3", settings.threads,
                                             look_ahead(settings)));
    return fmt::format("{}, preset {}",
                       set_quality(codec, options, settings, crf_alike(settings.quality, 35)), preset);
}

std::string set_up_aom_av1(AVCodecContext& codec, AvOptions& options, const CodecSettings& settings) {
    constexpr std::array<const char*, presets.size()> cpu_used{"8", "8", "8", "7", "6",
                                                               "5", "4", "3", "2", "1"};
    const char* speed = cpu_used[preset_number(settings.preset)];
    codec.gop_size = key_frame_distance(settings);
    options.set("cpu-used", speed);
    options.set("row-mt", "1");
    options.set("lag-in-frames", std::to_string(look_ahead(settings)));
    return fmt::format("{}, cpu-used {}",
                       set_quality(codec, options, settings, crf_alike(settings.quality, 35)), speed);
}

std::string set_up_ffv1(AVCodecContext& codec, AvOptions& options, const CodecSettings&) {
    codec.gop_size = 1;
    codec.level = 3;   // the version of RFC 9043, in which each slice has a checksum
    codec.slices = 4;  // fixed here; otherwise the bits would depend on the threads
    options.set("slicecrc", "1");
    return "lossless";
}

std::string set_up_gif(AVCodecContext& codec, AvOptions&, const CodecSettings&) {
    codec.flags &= ~AV_CODEC_FLAG_GLOBAL_HEADER;
    return "one palette";
}

std::string set_up_raw(AVCodecContext&, AvOptions&, const CodecSettings&) {
    return "not compressed";
}

}  // namespace grainreel
