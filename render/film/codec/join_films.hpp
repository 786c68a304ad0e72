// Joins films of one encoder without encoding them again. A piece gives its packets one after another, each
// with its place in the film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/film/codec/codec.hpp"
#include "render/film/codec/ffmpeg.hpp"

namespace grainreel {

struct FilmPiece {
    std::filesystem::path file;
    std::string name;         // for messages
    std::int64_t frames = 0;  // that it is to have
};

// What kept pieces from being joined: none, or asked to stop.
enum class JoinEnd { joined, stopped };

// Writes the pieces, in their order, as one film of so many frames a second, in the container of `codec`.
// `to` is replaced once all of it is there, and nothing else is left beside it. Every packet stays as it is
// but for its times. Throws UserError naming the piece that cannot be read, has other frames than it is to
// have or at other times, or is coded otherwise than the first one; RunError when writing fails. go_on: asked
// now and then; false: stop.
JoinEnd join_films(const std::vector<FilmPiece>& pieces, const Codec& codec, double rate,
                   const std::filesystem::path& to, const std::function<bool()>& go_on);

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
