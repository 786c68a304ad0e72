#include "render/film/codec/encoder.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/codec/bt709.hpp"
#include "render/film/codec/film_file.hpp"

namespace grainreel {

namespace {

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

AVPixelFormat pixels_of(const EncoderSettings& settings) {
    return settings.alpha ? settings.codec->pixels_with_alpha : settings.codec->pixels;
}

}  // namespace

CodecSettings codec_settings(const EncoderSettings& settings) {
    const EvenSize size = coded_size(settings.width, settings.height, pixels_of(settings));
    return {size.width,       size.height,     av_d2q(settings.rate, 100'000),
            settings.quality, settings.preset, settings.threads,
            settings.alpha,   settings.pass,   settings.bit_rate,
            settings.log};
}

Encoder::Encoder(const EncoderSettings& settings)
    : settings_(settings), conversion_(settings.width, settings.height, pixels_of(settings)) {
    const CodecSettings padded = codec_settings(settings);
    if (padded.width != settings.width || padded.height != settings.height)
        notes_.push_back(fmt::format(
            "{}x{} padded to {}x{}: {} needs even sizes to play everywhere; the last column or "
            "row is repeated",
            settings.width, settings.height, padded.width, padded.height, settings.codec->standard));
    OpenCodec open = open_codec(*settings.codec, padded);
    codec_ = std::move(open.context);
    description_ = fmt::format("{}: {}", settings.codec->words, open.description);
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
        // The film so far is on disk and plays. Errors are not reported here: callers that want them call
        // finish().
    }
}

std::string Encoder::name() const {
    return settings_.path == to_stdout ? "stdout" : settings_.path.string();
}

void Encoder::open_file() {
    const FilmContainer& container = settings_.codec->container;
    AVFormatContext* context = nullptr;
    avformat_alloc_output_context2(&context, nullptr, container.muxer, nullptr);
    file_.reset(context);
    AVStream* stream = context ? avformat_new_stream(context, nullptr) : nullptr;
    if (!stream || avcodec_parameters_from_context(stream->codecpar, codec_.get()) < 0)
        throw RunError("film: this libavformat writes no {}", settings_.codec->words);
    stream->time_base = codec_->time_base;
    stream->avg_frame_rate = codec_->framerate;
    if (!settings_.title.empty()) av_dict_set(&context->metadata, "title", settings_.title.c_str(), 0);
    av_dict_set(&context->metadata, "comment", settings_.comment.c_str(), 0);

    // Each fragment reaches the disk whole as soon as it ends.
    context->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    context->flags |= AVFMT_FLAG_BITEXACT;  // otherwise Matroska would write a random number
    AvOptions options;
    for (const auto& [key, value] : container.growing) options.set(key, value);
    const std::string url = settings_.path == to_stdout ? "pipe:1" : ffmpeg_url(settings_.path);
    if (settings_.path != to_stdout) make_way(settings_.path);
    int code = avio_open(&context->pb, url.c_str(), AVIO_FLAG_WRITE);
    if (code >= 0) code = avformat_write_header(context, options.get());
    if (code < 0) fail(code);
}

void Encoder::check_open() const {
    if (!file_) throw RunError("{}: closed after an error", name());
}

void Encoder::add(const Picture& picture) {
    check_open();
    const int code = av_frame_make_writable(frame_.get());  // the encoder may still read the last picture
    if (code < 0) fail(code);
    conversion_.convert(picture, *frame_);
    add(*frame_);
}

void Encoder::add(AVFrame& frame) {
    check_open();
    frame.pts = frames_ - group_;
    frame.pict_type = AV_PICTURE_TYPE_NONE;  // the encoder decides the type itself
    encode(&frame);
    ++frames_;
}

// Each group of frames (FilmWriter::begin_group()) gets an encoder of its own, because the rate control that
// an encoder keeps from group to group would change the bits.
void Encoder::begin_group() {
    check_open();
    if (frames_ == group_) return;
    encode(nullptr);
    codec_ = open_codec(*settings_.codec, codec_settings(settings_)).context;
    group_ = frames_;
}

// Encodes a frame; null drains the encoder.
void Encoder::encode(const AVFrame* frame) {
    int code = avcodec_send_frame(codec_.get(), frame);
    if (code < 0) fail(code);
    while ((code = avcodec_receive_packet(codec_.get(), packet_.get())) >= 0) write(*packet_);
    if (code != AVERROR(EAGAIN) && code != AVERROR_EOF) fail(code);
}

void Encoder::write(AVPacket& packet) {
    AVFormatContext& context = *file_;
    payload_ += packet.size;
    packet.duration = 1;
    packet.pts += group_;
    packet.dts += group_;
    packet.stream_index = 0;
    av_packet_rescale_ts(&packet, codec_->time_base, context.streams[0]->time_base);
    const int code = av_write_frame(&context, &packet);  // reports errors of the file, too
    av_packet_unref(&packet);
    if (code < 0) fail(code);
}

void Encoder::close() {
    if (frames_ > group_) encode(nullptr);  // without frames SVT-AV1 would wait for the first one for ever
    int code = av_write_trailer(file_.get());
    if (frames_ == 0) code = std::max(code, 0);  // without frames the GIF muxer fails, which does not matter
    if (code >= 0) code = avio_closep(&file_->pb);
    if (code < 0) fail(code);
    file_.reset();
}

void Encoder::finish() {
    check_open();
    close();
    const FilmContainer& container = settings_.codec->container;
    if (frames_ > 0 && !container.complete.empty()) remux_for_streaming(settings_.path, container);
}

void Encoder::fail(int code) {
    file_.reset();
    const std::string reason = ffmpeg_error(code);
    if (settings_.path == to_stdout)
        throw RunError(
            "stdout: cannot write the film: {}; after {} frames, {}", reason, frames_,
            code == AVERROR(EPIPE) ? "the program that reads it has ended" : "what was written plays");
    throw RunError("{}: cannot write the film: {}; {} frames were taken, what is on disk plays", name(),
                   reason, frames_);
}

EvenSize coded_size(int width, int height, AVPixelFormat pixels) {
    if (pixels != AV_PIX_FMT_YUV420P) return {width, height};
    return {width + width % 2, height + height % 2};
}

ColourConversion::ColourConversion(int width, int height, AVPixelFormat pixels)
    : width_(width), height_(height), coded_(coded_size(width, height, pixels)) {
    if (coded_width() > width || coded_height() > height) padded_ = Picture(coded_width(), coded_height());
    if (pixels == AV_PIX_FMT_PAL8 || pixels == AV_PIX_FMT_YUV420P) return;
    scaler_.reset(sws_getContext(width, height, AV_PIX_FMT_RGBA, width, height, pixels, SWS_POINT, nullptr,
                                 nullptr, nullptr));
    if (!scaler_) throw RunError("film: this libswscale does not convert from RGBA");
}

const Picture& ColourConversion::even(const Picture& picture) {
    if (padded_.width == 0) return picture;
    for (int y = 0; y < padded_.height; ++y) {
        const int from = std::min(y, height_ - 1);
        std::memcpy(padded_.pixel(0, y), picture.pixel(0, from), static_cast<std::size_t>(width_) * 4);
        if (padded_.width > width_) std::memcpy(padded_.pixel(width_, y), picture.pixel(width_ - 1, from), 4);
    }
    return padded_;
}

void ColourConversion::convert(const Picture& picture, AVFrame& target) {
    GRAINREEL_CHECK(picture.width == width_ && picture.height == height_);
    const Picture& source = even(picture);
    if (target.format == AV_PIX_FMT_YUV420P) {
        const YuvPlanes planes{target.data[0],     target.data[1],     target.data[2],
                               target.linesize[0], target.linesize[1], target.linesize[2]};
        if (picture.still != 0 && picture.still == still_) {
            for (const Rectangle& part : picture.moving) to_bt709(source, part, planes);
        } else {
            to_bt709(source, planes);
        }
        still_ = picture.still;
        return;
    }
    GRAINREEL_CHECK(scaler_);
    const std::uint8_t* planes[4] = {source.rgba.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {source.width * 4, 0, 0, 0};
    sws_scale(scaler_.get(), planes, strides, 0, source.height, target.data, target.linesize);
}

}  // namespace grainreel
