// Pictures in, an H.264 film in MP4 out. While it is written the file is fragmented, so that a killed process
// leaves a film that plays up to its last 2 s; finish() turns it into an ordinary MP4 with its index in
// front.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/draw/picture.hpp"
#include "render/film/colour_conversion.hpp"
#include "render/film/ffmpeg_handles.hpp"
#include "render/film/h264.hpp"

namespace grainreel {

struct EncoderSettings {
    std::filesystem::path path;
    int width = 0, height = 0;  // pixels of the pictures; an odd one is padded by one and noted
    double rate = 30;           // frames a second
    int crf = 20;
    std::string preset = "veryfast";
    int threads = 1;
    std::string title, comment;  // metadata, UTF-8
};

class Encoder {
  public:
    // Creates the file. Throws RunError when it cannot be written or no encoder is to be had.
    explicit Encoder(const EncoderSettings& settings);
    // Without finish(): writes what was taken in, and leaves the fragmented film, which plays.
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // Throws RunError, naming the file and the reason, when writing fails; what was written still plays, and
    // no more pictures are taken.
    void add(const Picture& picture);

    // Writes what is left and replaces the file by one for streaming. Throws RunError likewise.
    void finish();

    std::int64_t frames() const { return frames_; }
    const std::string& description() const { return description_; }
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    void open_file();
    void encode(const AVFrame* frame);
    void write(AVPacket& packet);
    void close();
    [[noreturn]] void fail(int code);

    EncoderSettings settings_;
    ColourConversion conversion_;
    std::string description_;
    std::vector<std::string> notes_;
    CodecPtr codec_;
    AvFramePtr frame_;
    PacketPtr packet_;
    OutputPtr file_;  // empty once closed or failed
    std::int64_t frames_ = 0;
};

}  // namespace grainreel
