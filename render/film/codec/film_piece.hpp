// A film's packets, one after another, each with its place in the film.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/film/codec/ffmpeg_handles.hpp"
#include "render/film/codec/join_films.hpp"

namespace grainreel {

class PieceReader {
  public:
    // rate: frames a second. All throw UserError naming the piece.
    PieceReader(const FilmPiece& piece, AVRational rate);

    const AVFormatContext& file() const { return *file_; }
    const AVStream& stream() const { return *file_->streams[0]; }

    // The next packet, in the order of coding; false after the last one, when all frames have come, each
    // once.
    bool next(AVPacket& packet);
    // The frame that the last packet shows, from 0, and how many packets came before it.
    std::int64_t frame() const { return frame_; }
    std::int64_t place() const { return place_; }
    // Frames by which the first packet is decoded before it is shown; known from the first packet on.
    std::int64_t delay() const { return delay_; }

  private:
    void take(const AVPacket& packet);
    [[noreturn]] void fail(const std::string& what) const;

    const FilmPiece piece_;
    const AVRational frame_time_;
    InputPtr file_;
    std::vector<bool> came_;
    std::int64_t frame_ = 0, place_ = -1, delay_ = 0;
};

}  // namespace grainreel
