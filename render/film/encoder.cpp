#include "render/film/encoder.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/remux.hpp"

namespace grainreel {
namespace {

// Shortest that still costs next to nothing: a fragment's header is some hundred bytes.
constexpr std::int64_t fragment_microseconds = 500'000;

AvFramePtr make_frame(const AVCodecContext& codec) {
    AvFramePtr frame(av_frame_alloc());
    if (!frame) throw RunError("film: no memory for a frame");
    frame->format = codec.pix_fmt;
    frame->width = codec.width;
    frame->height = codec.height;
    frame->color_primaries = codec.color_primaries;
    frame->color_trc = codec.color_trc;
    frame->colorspace = codec.colorspace;
    frame->color_range = codec.color_range;
    frame->chroma_location = codec.chroma_sample_location;
    if (av_frame_get_buffer(frame.get(), 0) < 0) throw RunError("film: no memory for a frame");
    return frame;
}

H264Settings h264_settings(const EncoderSettings& settings, const ColourConversion& conversion) {
    return {conversion.coded_width(), conversion.coded_height(), av_d2q(settings.rate, 100'000), settings.crf,
            settings.preset,          settings.threads};
}

}  // namespace

Encoder::Encoder(const EncoderSettings& settings)
    : settings_(settings), conversion_(settings.width, settings.height) {
    quiet_ffmpeg();
    if (conversion_.coded_width() != settings.width || conversion_.coded_height() != settings.height)
        notes_.push_back(fmt::format(
            "{}x{} padded to {}x{}: H.264 for browsers needs even sizes; the last "
            "column or row is repeated",
            settings.width, settings.height, conversion_.coded_width(), conversion_.coded_height()));
    const H264Settings h264 = h264_settings(settings, conversion_);
    codec_ = open_h264(h264);
    description_ = describe_h264(*codec_, h264);
    frame_ = make_frame(*codec_);
    packet_.reset(av_packet_alloc());
    if (!packet_) throw RunError("film: no memory for a packet");
    open_file();
}

Encoder::~Encoder() {
    if (!file_) return;
    try {
        close();
    } catch (const RunError&) {
        // The film so far is on disk and plays; who wanted to know of errors called finish().
    }
}

void Encoder::open_file() {
    AVFormatContext* context = nullptr;
    avformat_alloc_output_context2(&context, nullptr, "mp4", nullptr);
    file_.reset(context);
    AVStream* stream = context ? avformat_new_stream(context, nullptr) : nullptr;
    if (!stream || avcodec_parameters_from_context(stream->codecpar, codec_.get()) < 0)
        throw RunError("film: this libavformat writes no MP4");
    stream->time_base = codec_->time_base;
    stream->avg_frame_rate = codec_->framerate;
    av_dict_set(&context->metadata, "title", settings_.title.c_str(), 0);
    av_dict_set(&context->metadata, "comment", settings_.comment.c_str(), 0);

    // Each fragment reaches the disk whole as soon as it ends.
    context->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    AvOptions options;
    options.set("movflags", "frag_keyframe+empty_moov+default_base_moof");
    options.set("frag_duration", std::to_string(fragment_microseconds));
    int code = avio_open(&context->pb, ffmpeg_url(settings_.path).c_str(), AVIO_FLAG_WRITE);
    if (code >= 0) code = avformat_write_header(context, options.get());
    if (code < 0) fail(code);
}

void Encoder::add(const Picture& picture) {
    if (!file_) throw RunError(fmt::format("{}: closed after an error", settings_.path.string()));
    const int code = av_frame_make_writable(frame_.get());  // x264 may still read the last one
    if (code < 0) fail(code);
    conversion_.convert(picture, *frame_);
    frame_->pts = frames_;
    encode(frame_.get());
    ++frames_;
}

// Null drains the encoder.
void Encoder::encode(const AVFrame* frame) {
    int code = avcodec_send_frame(codec_.get(), frame);
    if (code < 0) fail(code);
    while ((code = avcodec_receive_packet(codec_.get(), packet_.get())) >= 0) write(*packet_);
    if (code != AVERROR(EAGAIN) && code != AVERROR_EOF) fail(code);
}

void Encoder::write(AVPacket& packet) {
    AVFormatContext& context = *file_;
    packet.duration = 1;
    packet.stream_index = 0;
    av_packet_rescale_ts(&packet, codec_->time_base, context.streams[0]->time_base);
    const int code = av_write_frame(&context, &packet);  // tells of the file's errors, too
    av_packet_unref(&packet);
    if (code < 0) fail(code);
}

void Encoder::close() {
    encode(nullptr);
    int code = av_write_trailer(file_.get());
    if (code >= 0) code = avio_closep(&file_->pb);
    if (code < 0) fail(code);
    file_.reset();
}

void Encoder::finish() {
    if (!file_) throw RunError(fmt::format("{}: closed after an error", settings_.path.string()));
    close();
    remux_for_streaming(settings_.path);
}

void Encoder::fail(int code) {
    file_.reset();
    throw RunError(fmt::format("{}: cannot write the film: {}; {} frames were taken, what is on disk plays",
                               settings_.path.string(), ffmpeg_error(code), frames_));
}

}  // namespace grainreel
