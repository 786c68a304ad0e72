#include "render/film/codec/film_piece.hpp"

#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/codec/film_file.hpp"

namespace grainreel {

PieceReader::PieceReader(const FilmPiece& piece, AVRational rate)
    : piece_(piece), frame_time_(av_inv_q(rate)) {
    // A coded frame has a byte at least: what a file says of its length is not believed beyond that.
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(piece.file, error);
    if (error) fail(error.message());
    if (piece.frames < 1 || static_cast<std::uintmax_t>(piece.frames) > size)
        fail(fmt::format("has {} bytes, too few for its {} pictures", size, piece.frames));
    const int code = open_film(piece.file, file_);
    if (code < 0) fail("cannot be read: " + ffmpeg_error(code));
    if (file_->nb_streams != 1 || stream().codecpar->codec_type != AVMEDIA_TYPE_VIDEO)
        fail("is no film of ours");
    came_.resize(static_cast<std::size_t>(piece.frames), false);
}

void PieceReader::fail(const std::string& what) const {
    throw UserError(fmt::format("{}: {}; draw that part again", piece_.name, what));
}

bool PieceReader::next(AVPacket& packet) {
    const int code = av_read_frame(file_.get(), &packet);
    if (code < 0 && code != AVERROR_EOF) fail("cannot be read: " + ffmpeg_error(code));
    if (code == AVERROR_EOF) {
        if (place_ + 1 < piece_.frames)
            fail(fmt::format("has {} pictures, but its run.json says {}", place_ + 1, piece_.frames));
        return false;
    }
    take(packet);
    return true;
}

void PieceReader::take(const AVPacket& packet) {
    if ((packet.flags & AV_PKT_FLAG_CORRUPT) != 0 || packet.size <= 0) fail("is damaged");
    if (packet.pts == AV_NOPTS_VALUE) fail("has a picture without a time");
    if (++place_ == piece_.frames)
        fail(fmt::format("has more pictures than the {} that its run.json says", piece_.frames));
    if (place_ == 0 && (packet.flags & AV_PKT_FLAG_KEY) == 0) fail("does not begin with a key frame");
    const AVRational base = stream().time_base;
    frame_ = av_rescale_q(packet.pts, base, frame_time_);
    const bool there = frame_ >= 0 && frame_ < piece_.frames;
    if (!there || std::abs(av_rescale_q(frame_, frame_time_, base) - packet.pts) > 1)
        fail(fmt::format("has a picture at {:.6g} s, where its rate has none",
                         static_cast<double>(packet.pts) * av_q2d(base)));
    if (came_[static_cast<std::size_t>(frame_)]) fail("has two pictures at one time");
    came_[static_cast<std::size_t>(frame_)] = true;
    if (place_ == 0 && packet.dts != AV_NOPTS_VALUE)
        delay_ = frame_ - av_rescale_q(packet.dts, base, frame_time_);
}

}  // namespace grainreel
