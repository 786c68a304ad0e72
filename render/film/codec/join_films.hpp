// Joins films (pieces) of the same encoder without encoding them again. PieceReader gives the packets of a
// piece one after another, each with its place in the piece.
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
    std::string name;         // the piece's name in messages
    std::int64_t frames = 0;  // number of frames that it must have
};

// How joining ended: with the film, or because the caller asked to stop.
enum class JoinEnd { joined, stopped };

// Writes the pieces, in their order, as one film with `rate` frames a second, in the container of `codec`.
// The film gets the name `to` only when it is complete, and no unfinished file stays beside it. Joining
// changes the times of the packets and nothing else in them. Throws UserError that names the piece when a
// piece cannot be read, has a wrong number of frames or wrong times, or is coded otherwise than the first
// one. Throws RunError when writing fails. go_on is called now and then and stops the work by returning
// false.
JoinEnd join_films(const std::vector<FilmPiece>& pieces, const Codec& codec, double rate,
                   const std::filesystem::path& to, const std::function<bool()>& go_on);

class PieceReader {
  public:
    // rate: frames a second. All functions throw UserError that names the piece.
    PieceReader(const FilmPiece& piece, AVRational rate);

    const AVFormatContext& file() const { return *file_; }
    const AVStream& stream() const { return *file_->streams[0]; }

    // Reads the next packet in the order of coding. Returns false after the last packet. By then each frame
    // has come exactly once; otherwise it throws.
    bool next(AVPacket& packet);
    // The frame that the last packet shows, from 0, and how many packets came before it.
    std::int64_t frame() const { return frame_; }
    std::int64_t place() const { return place_; }
    // Number of frames between decoding the first packet and showing it; known once the first packet is read.
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
