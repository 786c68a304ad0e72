#include "render/film/codec/ffmpeg_handles.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

namespace grainreel {
namespace {

struct ErrorLog {
    std::mutex mutex;
    std::string last;
};

// Codecs log from their own threads, up to the end of the process: never destroyed.
ErrorLog& error_log() {
    static ErrorLog& log = *new ErrorLog;
    return log;
}

void collect(void*, int level, const char* format, std::va_list arguments) {
    if (level > AV_LOG_ERROR) return;
    std::array<char, 512> line{};
    std::vsnprintf(line.data(), line.size(), format, arguments);
    std::string text = line.data();
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (text.empty()) return;
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    log.last = std::move(text);
}

// One black picture for an encoder, and what comes of it thrown away.
void encode_nothing(AVCodecContext& codec) {
    const AvFramePtr frame(av_frame_alloc());
    if (!frame) return;
    frame->format = codec.pix_fmt;
    frame->width = codec.width;
    frame->height = codec.height;
    frame->pts = 0;
    if (av_frame_get_buffer(frame.get(), 0) < 0) return;
    for (int plane = 0; frame->buf[plane]; ++plane)
        std::memset(frame->buf[plane]->data, 0, static_cast<std::size_t>(frame->buf[plane]->size));
    const PacketPtr packet(av_packet_alloc());
    avcodec_send_frame(&codec, frame.get());
    avcodec_send_frame(&codec, nullptr);
    while (packet && avcodec_receive_packet(&codec, packet.get()) >= 0) av_packet_unref(packet.get());
}

}  // namespace

void free_codec(AVCodecContext* codec) {
    // SVT-AV1 1.4 that never had a picture waits for one for ever when it is closed.
    const bool waits = avcodec_is_open(codec) && av_codec_is_encoder(codec->codec) &&
                       codec->codec_id == AV_CODEC_ID_AV1 && codec->frame_number == 0;
    if (waits) encode_nothing(*codec);
    av_freep(&codec->stats_in);  // ours, of a second pass
    avcodec_free_context(&codec);
}

void quiet_ffmpeg() {
    static std::once_flag once;
    std::call_once(once, [] {
        av_log_set_callback(collect);
        ::setenv("SVT_LOG", "1", 0);  // SVT-AV1 prints past FFmpeg's log; from 1 on errors alone
    });
}

std::string ffmpeg_error(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(code, reason.data(), reason.size());
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    const std::string detail = std::exchange(log.last, {});
    return detail.empty() ? reason.data() : std::string(reason.data()) + " (" + detail + ")";
}

}  // namespace grainreel
