#include "render/page/film/small_jpeg.hpp"

#include "render/film/codec/ffmpeg.hpp"

namespace grainreel {
namespace {

constexpr const char* filter =
    "scale=min(960\\,iw):-2:in_color_matrix=bt709:out_color_matrix=bt601:"
    "out_range=full,format=yuvj420p";

std::vector<std::uint8_t> as_jpeg(AVFrame& picture) {
    const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_MJPEG);
    const CodecPtr codec(encoder ? avcodec_alloc_context3(encoder) : nullptr);
    const PacketPtr packet(av_packet_alloc());
    if (!codec || !packet) return {};
    codec->width = picture.width;
    codec->height = picture.height;
    codec->pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec->time_base = {1, 1};
    codec->flags |= AV_CODEC_FLAG_QSCALE;
    constexpr int quality = 4;  // of 1 to 31, the best first; small digits read
    codec->global_quality = quality * FF_QP2LAMBDA;
    picture.quality = codec->global_quality;
    if (avcodec_open2(codec.get(), encoder, nullptr) < 0) return {};
    if (avcodec_send_frame(codec.get(), &picture) < 0) return {};
    if (avcodec_receive_packet(codec.get(), packet.get()) < 0) return {};
    return {packet->data, packet->data + packet->size};
}

}  // namespace

std::vector<std::uint8_t> small_jpeg(const AVCodecContext& decoder, AVFrame& frame) {
    FilterGraph graph(decoder, filter);
    graph.push(frame);
    graph.end();
    const AvFramePtr small = graph.pull();
    return small ? as_jpeg(*small) : std::vector<std::uint8_t>();
}

}  // namespace grainreel
