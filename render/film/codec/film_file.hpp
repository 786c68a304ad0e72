// Reads films on disk: decodes their frames one after another, and copies their packets without decoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "render/film/codec/codec.hpp"
#include "render/film/codec/ffmpeg.hpp"

namespace grainreel {

class FilmReader {
  public:
    // threads: number of threads that decode. Throws RunError when the file is no film.
    explicit FilmReader(const std::filesystem::path& path, int threads = 1);

    // Gives the next frame; null at the end. It is valid until the next call. Throws RunError when the file
    // is damaged.
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

// Counts the complete pictures in a film without decoding them. Throws RunError when the file is no film.
std::int64_t pictures_in(const std::filesystem::path& film);

// Frames a second as the film's file says; 0 where it does not. Throws RunError when the file is no film.
double frame_rate_of(const std::filesystem::path& film);

// Copies the film's packets to `path`.part, syncs it and renames it to `path`. When that fails, throws
// RunError with the file and the reason, and leaves the film as it was written.
void remux_for_streaming(const std::filesystem::path& path, const FilmContainer& container);

// Syncs `from` to disk and renames it to `to`. Returns 0 or a negative error of FFmpeg.
int replace_synced(const std::filesystem::path& from, const std::filesystem::path& to);

// Opens an ordinary file for reading. Returns 0 or a negative error of FFmpeg. It does not wait for a pipe.
int open_film(const std::filesystem::path& path, InputPtr& input);

// The path in the form that FFmpeg needs: a colon in a name must not look like a protocol.
std::string ffmpeg_url(const std::filesystem::path& path);

}  // namespace grainreel
