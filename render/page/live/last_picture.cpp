#include "render/page/live/last_picture.hpp"

#include <utility>

#include "engine/base/error.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_file.hpp"
#include "render/page/page_film.hpp"

namespace grainreel {
namespace {

// The packets from the last key frame on: reading the others without decoding them costs next to nothing.
std::vector<PacketPtr> last_packets(AVFormatContext& film, int stream) {
    std::vector<PacketPtr> packets;
    while (true) {
        PacketPtr packet(av_packet_alloc());
        // What is not whole yet ends the film.
        if (!packet || av_read_frame(&film, packet.get()) < 0) return packets;
        if (packet->stream_index != stream) continue;
        if ((packet->flags & AV_PKT_FLAG_KEY) != 0) packets.clear();
        packets.push_back(std::move(packet));
    }
}

CodecPtr decoder_of(const AVStream& stream) {
    const AVCodec* decoder = avcodec_find_decoder(stream.codecpar->codec_id);
    CodecPtr codec(decoder != nullptr ? avcodec_alloc_context3(decoder) : nullptr);
    if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
    codec->thread_count = 1;
    return avcodec_open2(codec.get(), decoder, nullptr) < 0 ? nullptr : std::move(codec);
}

AvFramePtr last_frame(AVCodecContext& codec, const std::vector<PacketPtr>& packets) {
    AvFramePtr last, next(av_frame_alloc());
    const auto take = [&] {
        while (avcodec_receive_frame(&codec, next.get()) >= 0) {
            last = std::move(next);
            next.reset(av_frame_alloc());
        }
    };
    for (const PacketPtr& packet : packets) {
        avcodec_send_packet(&codec, packet.get());
        take();
    }
    avcodec_send_packet(&codec, nullptr);
    take();
    return last;
}

}  // namespace

std::vector<std::uint8_t> last_picture(const std::filesystem::path& film) {
    quiet_ffmpeg();
    InputPtr file;
    if (open_film(film, file) < 0) return {};
    AVFormatContext* const context = file.get();
    if (avformat_find_stream_info(context, nullptr) < 0) return {};
    const int stream = av_find_best_stream(context, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream < 0) return {};
    const CodecPtr codec = decoder_of(*context->streams[stream]);
    if (!codec) return {};
    const AvFramePtr frame = last_frame(*codec, last_packets(*context, stream));
    if (!frame) return {};
    try {
        return small_jpeg(*codec, *frame);
    } catch (const RunError&) {
        return {};
    }
}

}  // namespace grainreel
