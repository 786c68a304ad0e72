// Encodes pictures as a film of one codec. While it is written, its file consists of short fragments or
// clusters, so that a killed process leaves a film that plays and lacks 2 s at most. finish() turns it into a
// file with its index in front, if the container has such a form.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/film/codec/codec.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

struct EvenSize {
    int width = 0, height = 0;  // pixels
};

// Size of the encoded pictures: where the chroma is halved an odd width or height grows by one.
EvenSize coded_size(int width, int height, AVPixelFormat pixels);

class ColourConversion {
  public:
    // width, height: of the pictures, in pixels. Where the coded size is larger the last column or row is
    // repeated. pixels: yuv420p, bgr0, bgra or pal8; pal8 is not converted here.
    ColourConversion(int width, int height, AVPixelFormat pixels = AV_PIX_FMT_YUV420P);

    int coded_width() const { return coded_.width; }
    int coded_height() const { return coded_.height; }

    // Converts a picture. `target` has the coded size and is writable; it still holds the picture that was
    // converted before, if there is one.
    void convert(const Picture& picture, AVFrame& target);

  private:
    const Picture& even(const Picture& picture);

    int width_, height_;
    EvenSize coded_;
    ScalerPtr scaler_;         // puts the same RGB in another order
    Picture padded_;           // used only when the width or height is odd
    std::uint64_t still_ = 0;  // number of the picture converted before
};

inline constexpr const char* to_stdout = "-";  // as a path: the film goes to stdout

struct EncoderSettings {
    const Codec* codec = &codec_of(FilmFormat::mp4);
    std::filesystem::path path;
    int width = 0,
        height = 0;    // pixels of the pictures; an odd size may be padded by one pixel, which is noted
    double rate = 30;  // frames a second
    int quality = 20;  // film.quality
    std::string preset = "veryfast";
    bool alpha = false;
    int threads = 1;
    int pass = 0;               // pass, bit_rate and log: see CodecSettings
    std::int64_t bit_rate = 0;  // bits/s
    std::string log;
    std::string title, comment;  // metadata, UTF-8
};

class Encoder final : public FilmWriter {
  public:
    // Creates the file. Throws RunError when it cannot be written or there is no encoder.
    explicit Encoder(const EncoderSettings& settings);
    // If finish() was not called: writes the pictures that were added and leaves the film as it is; it plays.
    ~Encoder() override;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // Adds a picture. Throws RunError, naming the file and the reason, when writing fails. What was written
    // still plays, but no more pictures are taken.
    void add(const Picture& picture) override;
    // Adds a frame in the codec's pixels and size; its time stamp is set here.
    void add(AVFrame& frame);
    void begin_group() override;

    // Writes what is left and replaces the file by one for streaming. Throws RunError as above.
    void finish() override;

    std::int64_t frames() const { return frames_; }
    std::int64_t payload() const { return payload_; }  // bytes of the coded pictures, without the container
    std::string description() const override { return description_; }
    std::vector<std::string> notes() const override { return notes_; }

  private:
    void open_file();
    void encode(const AVFrame* frame);
    void write(AVPacket& packet);
    void close();
    void check_open() const;
    std::string name() const;
    [[noreturn]] void fail(int code);

    EncoderSettings settings_;
    ColourConversion conversion_;
    std::string description_;
    std::vector<std::string> notes_;
    CodecPtr codec_;
    AvFramePtr frame_;
    PacketPtr packet_;
    OutputPtr file_;  // empty once closed or failed
    std::int64_t frames_ = 0, payload_ = 0;
    std::int64_t group_ = 0;  // the first frame that codec_ has taken
};

// The settings of the codec, with the size padded where it must be even.
CodecSettings codec_settings(const EncoderSettings& settings);

}  // namespace grainreel
