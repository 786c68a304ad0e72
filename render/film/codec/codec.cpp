#include "render/film/codec/codec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "render/film/codec/encoder_setup.hpp"

namespace grainreel {
namespace {

// Half a second of film at most waits for a fragment or cluster to be whole; their headers are some hundred
// bytes.
const FilmContainer mp4{
    "mp4",
    {{"movflags", "frag_keyframe+empty_moov+default_base_moof"}, {"frag_duration", "500000"}},
    {{"movflags", "faststart"}}};
const FilmContainer webm{"webm", {{"cluster_time_limit", "500"}}, {{"cues_to_front", "1"}}};
const FilmContainer matroska{"matroska", {{"cluster_time_limit", "500"}}, {}};
const FilmContainer gif{"gif", {{"loop", "0"}}, {}};
const FilmContainer y4m{"yuv4mpegpipe", {}, {}};

constexpr AVPixelFormat yuv = AV_PIX_FMT_YUV420P;  // browsers refuse anything finer
constexpr AVPixelFormat no_alpha = AV_PIX_FMT_NONE;

const Codec h264{
    "H.264 in MP4", "mp4", "H.264", mp4, {{"libx264", set_up_x264}, {"libopenh264", set_up_openh264}}, yuv,
    no_alpha,       true};
const Codec vp9{"VP9 in WebM", "webm", "VP9", webm, {{"libvpx-vp9", set_up_vp9}}, yuv, no_alpha};
// In MP4, not WebM: Safari plays AV1 in MP4 alone, all others both.
const Codec av1{
    "AV1 in MP4", "mp4",   "AV1", mp4, {{"libsvtav1", set_up_svt_av1}, {"libaom-av1", set_up_aom_av1}},
    yuv,          no_alpha};
const Codec ffv1{"FFV1 in Matroska",      "mkv",           "FFV1",         matroska,
                 {{"ffv1", set_up_ffv1}}, AV_PIX_FMT_BGR0, AV_PIX_FMT_BGRA};
const Codec palette{"GIF", "gif", "GIF", gif, {{"gif", set_up_gif}}, AV_PIX_FMT_PAL8, no_alpha};
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
    throw RunError(fmt::format(
        "film: this machine's FFmpeg has no {} encoder ({}); install FFmpeg libraries built with {} "
        "(Debian: libavcodec59), choose another --format, or ask for --no-film --frames",
        codec.standard, fmt::join(names, ", "), names.front()));
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
            return palette;
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
            throw RunError(fmt::format("film: {} refused size {}x{}, {:g} frames/s, {}: {}", setup.name,
                                       settings.width, settings.height, av_q2d(settings.rate), words,
                                       ffmpeg_error(code)));
        open.description = fmt::format("{} ({}), {}{} thread{}", setup.name, LIBAVCODEC_IDENT,
                                       words.empty() ? "" : words + ", ", settings.threads,
                                       settings.threads == 1 ? "" : "s");
        return open;
    }
    no_encoder(codec);
}

}  // namespace grainreel
