// Frames of a film file, one after another, as its decoder gives them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "render/film/codec/ffmpeg_handles.hpp"

namespace grainreel {

class FilmReader {
  public:
    // threads: that decode. Throws RunError when the file is no film.
    explicit FilmReader(const std::filesystem::path& path, int threads = 1);

    // The next frame; null at the end. Valid until the next call. Throws RunError when the file is damaged.
    AVFrame* next();

    const AVCodecContext& codec() const { return *codec_; }

  private:
    void check(int code) const;
    bool feed();

    std::filesystem::path path_;
    InputPtr file_;
    CodecPtr codec_;
    PacketPtr packet_;
    AvFramePtr frame_;
};

// Pictures that are whole in a film, without decoding them. Throws RunError when the file is no film.
std::int64_t pictures_in(const std::filesystem::path& film);

}  // namespace grainreel
