// Pictures in, a film of one codec out. While it is written the file consists of short fragments or clusters,
// so that a killed process leaves a film that plays up to its last 2 s; finish() turns it into one with its
// index in front where the container has such a form.
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

// Where the chroma is halved an odd width or height grows by one.
EvenSize coded_size(int width, int height, AVPixelFormat pixels);

class ColourConversion {
  public:
    // Size of the pictures, pixels. Where the coded size is larger the last column or row is repeated.
    // pixels: yuv420p, bgr0, bgra, or pal8, for which there is nothing to convert here.
    ColourConversion(int width, int height, AVPixelFormat pixels = AV_PIX_FMT_YUV420P);

    int coded_width() const { return coded_.width; }
    int coded_height() const { return coded_.height; }

    // `target`: of the coded size, writable; it holds the picture converted before, if there is one.
    void convert(const Picture& picture, AVFrame& target);

  private:
    const Picture& even(const Picture& picture);

    int width_, height_;
    EvenSize coded_;
    ScalerPtr scaler_;         // of the same RGB in another order
    Picture padded_;           // only used when a size is odd
    std::uint64_t still_ = 0;  // of the picture converted before
};

inline constexpr const char* to_stdout = "-";  // a path

struct EncoderSettings {
    const Codec* codec = &codec_of(FilmFormat::mp4);
    std::filesystem::path path;
    int width = 0, height = 0;  // pixels of the pictures; an odd one may be padded by one and noted
    double rate = 30;           // frames a second
    int quality = 20;           // as film.quality
    std::string preset = "veryfast";
    bool alpha = false;
    int threads = 1;
    int pass = 0;               // and what belongs to it: see CodecSettings
    std::int64_t bit_rate = 0;  // bits/s
    std::string log;
    std::string title, comment;  // metadata, UTF-8
};

class Encoder final : public FilmWriter {
  public:
    // Creates the file. Throws RunError when it cannot be written or no encoder is to be had.
    explicit Encoder(const EncoderSettings& settings);
    // Without finish(): writes what was taken in, and leaves the film as it grew, which plays.
    ~Encoder() override;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // Throws RunError, naming the file and the reason, when writing fails; what was written still plays, and
    // no more pictures are taken.
    void add(const Picture& picture) override;
    // The next frame, in the codec's pixels and size; its time stamp is set here.
    void add(AVFrame& frame);
    void begin_group() override;

    // Writes what is left and replaces the file by one for streaming. Throws RunError as above.
    void finish() override;

    std::int64_t frames() const { return frames_; }
    std::int64_t payload() const { return payload_; }  // bytes of coded pictures, without the container's
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

// What an encoder is asked for, the size padded where it must be even.
CodecSettings codec_settings(const EncoderSettings& settings);

}  // namespace grainreel
