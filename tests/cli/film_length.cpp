// Counts the pictures in a film file by decoding it.
#include "tests/cli/film_length.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace grainreel::test {

namespace {

int received(AVCodecContext* decoder, AVFrame* picture) {
    int count = 0;
    while (avcodec_receive_frame(decoder, picture) == 0) ++count;
    return count;
}

}  // namespace

int decoded_pictures(const std::filesystem::path& film) {
    AVFormatContext* format = nullptr;
    av_log_set_level(AV_LOG_QUIET);
    if (avformat_open_input(&format, film.c_str(), nullptr, nullptr) < 0) return -1;
    const AVCodec* codec = nullptr;
    const bool readable = avformat_find_stream_info(format, nullptr) >= 0;
    const int stream = readable ? av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0) : -1;
    if (stream < 0) {
        avformat_close_input(&format);
        return -1;
    }
    AVCodecContext* decoder = avcodec_alloc_context3(codec);
    avcodec_parameters_to_context(decoder, format->streams[stream]->codecpar);
    avcodec_open2(decoder, codec, nullptr);
    AVPacket* packet = av_packet_alloc();
    AVFrame* picture = av_frame_alloc();
    int pictures = 0;
    for (; av_read_frame(format, packet) >= 0; av_packet_unref(packet)) {
        if (packet->stream_index != stream) continue;
        avcodec_send_packet(decoder, packet);
        pictures += received(decoder, picture);
    }
    avcodec_send_packet(decoder, nullptr);
    pictures += received(decoder, picture);
    av_frame_free(&picture);
    av_packet_free(&packet);
    avcodec_free_context(&decoder);
    avformat_close_input(&format);
    return pictures;
}

}  // namespace grainreel::test
