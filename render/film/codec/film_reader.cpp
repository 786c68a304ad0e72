#include "render/film/codec/film_reader.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/codec/remux.hpp"

namespace grainreel {

FilmReader::FilmReader(const std::filesystem::path& path, int threads)
    : path_(path), packet_(av_packet_alloc()), frame_(av_frame_alloc()) {
    check(open_film(path, file_));
    check(avformat_find_stream_info(file_.get(), nullptr));
    const AVCodecParameters& parameters = *file_->streams[0]->codecpar;
    codec_.reset(avcodec_alloc_context3(avcodec_find_decoder(parameters.codec_id)));
    check(codec_ && packet_ && frame_ ? 0 : AVERROR(ENOMEM));
    check(avcodec_parameters_to_context(codec_.get(), &parameters));
    codec_->thread_count = threads;
    check(avcodec_open2(codec_.get(), nullptr, nullptr));
}

AVFrame* FilmReader::next() {
    int code = 0;
    while ((code = avcodec_receive_frame(codec_.get(), frame_.get())) == AVERROR(EAGAIN))
        if (!feed()) check(avcodec_send_packet(codec_.get(), nullptr));
    if (code == AVERROR_EOF) return nullptr;
    check(code);
    return frame_.get();
}

// One more packet to the decoder; false when there is none.
bool FilmReader::feed() {
    const int code = av_read_frame(file_.get(), packet_.get());
    if (code == AVERROR_EOF) return false;
    check(code);
    check(avcodec_send_packet(codec_.get(), packet_.get()));
    av_packet_unref(packet_.get());
    return true;
}

std::int64_t pictures_in(const std::filesystem::path& film) {
    const auto check = [&](int code) {
        if (code < 0)
            throw RunError(fmt::format("{}: cannot be read back: {}", film.string(), ffmpeg_error(code)));
    };
    InputPtr file;
    check(open_film(film, file));
    const PacketPtr packet(av_packet_alloc());
    check(packet ? 0 : AVERROR(ENOMEM));
    std::int64_t count = 0;
    while (av_read_frame(file.get(), packet.get()) >= 0) {
        count += packet->stream_index == 0 && (packet->flags & AV_PKT_FLAG_CORRUPT) == 0;
        av_packet_unref(packet.get());
    }
    return count;
}

void FilmReader::check(int code) const {
    if (code < 0)
        throw RunError(fmt::format("{}: cannot be read back: {}", path_.string(), ffmpeg_error(code)));
}

}  // namespace grainreel
