#include "render/film/codec/spooled_films.hpp"

#include <fmt/format.h>
#include <array>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_file.hpp"
#include "render/film/codec/film_writer.hpp"

namespace grainreel {

namespace {

constexpr double aim = 0.96, least = 0.9;  // the wanted and the least size, as shares of the cap
constexpr int most_passes = 4;             // the first one is nearly always good enough
constexpr const char* fitted = "fitted";   // name of the film encoded anew, in the work folder

EncoderSettings first_settings(EncoderSettings settings, const WorkFolder& work) {
    if (!settings.codec->film_is_first_pass) return settings;
    settings.pass = 1;
    settings.log = work.file("pass.log");
    return settings;
}

// The settings of the exact copy, in the pixels that `spool` stores.
EncoderSettings spool_settings(EncoderSettings settings, const Codec& spool, const WorkFolder& work) {
    settings.codec = &spool;
    settings.path = work.file("spool.mkv");
    return settings;
}

std::int64_t size_of(const std::filesystem::path& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) throw RunError("{}: cannot be found again: {}", path.string(), error.message());
    return static_cast<std::int64_t>(size);
}

}  // namespace

CappedFilm::CappedFilm(const EncoderSettings& settings, std::int64_t cap)
    : settings_(settings),
      cap_(cap),
      work_(settings.path),
      film_(std::make_unique<Encoder>(first_settings(settings, work_))),
      spool_(std::make_unique<Encoder>(spool_settings(settings, spool_of_yuv(), work_))),
      description_(film_->description()),
      notes_(film_->notes()) {}

void CappedFilm::add(const Picture& picture) {
    film_->add(picture);
    spool_->add(picture);
}

void CappedFilm::finish() {
    spool_->finish();
    film_->finish();
    const std::int64_t size = size_of(settings_.path);
    result_ =
        fmt::format("{} at this quality, below the cap of {}", data_size_text(static_cast<double>(size)),
                    data_size_text(static_cast<double>(cap_)));
    if (size > cap_) fit(size);
    work_.remove();
}

// Encodes the film anew so that it fits under its cap, if it stays legible.
void CappedFilm::fit(std::int64_t size) {
    const auto overhead = static_cast<double>(size - film_->payload());  // bytes of the container
    film_.reset();  // x264 writes the last of its log when it is closed
    const std::int64_t floor = settings_.quality < least_legible ? encode_legible() : size;
    if (floor > cap_) refuse(size, floor, overhead);
    if (static_cast<double>(floor) >= least * static_cast<double>(cap_)) {
        result_ =
            fmt::format("{} at quality {}, under the cap of {}", data_size_text(static_cast<double>(floor)),
                        least_legible, data_size_text(static_cast<double>(cap_)));
        return take_fitted();
    }
    fill(overhead);
}

void CappedFilm::refuse(std::int64_t size, std::int64_t floor, double overhead) const {
    const auto cap = static_cast<double>(cap_);
    const auto frames = spool_->frames();
    const double share = std::max(0.0, cap - overhead) / (static_cast<double>(floor) - overhead);
    throw RunError(
        "{}: a cap of {} is too small for this film: below {} small digits on its frames read "
        "wrong. What fits: {}; "
        "or raise --max-size (the whole film is kept, {})",
        settings_.path.string(), data_size_text(cap), data_size_text(static_cast<double>(floor)),
        smaller_film(settings_.width, settings_.height, frames, share),
        data_size_text(static_cast<double>(size)));
}

// Encodes the film again, each time with a rate corrected by the last size, until the size is within its
// bounds.
void CappedFilm::fill(double overhead) {
    const auto cap = static_cast<double>(cap_);
    const double room = aim * cap - overhead;
    const std::string log = first_pass();
    const double seconds = static_cast<double>(spool_->frames()) / settings_.rate;
    double rate = 8 * room / seconds;
    for (int pass = 1; pass <= most_passes; ++pass) {
        const std::int64_t got = encode_at(std::llround(rate), log);
        result_ = fmt::format("{} in two passes of {:.0f} kbit/s, under the cap of {}",
                              data_size_text(static_cast<double>(got)), rate / 1000, data_size_text(cap));
        const bool fits = got <= cap_ && static_cast<double>(got) >= least * cap;
        if (fits || (pass == most_passes && got <= cap_)) return take_fitted();
        rate *= room / std::max(1.0, static_cast<double>(got) - overhead);
    }
    throw RunError(
        "{}: {} could not be brought under the cap of {}; raise --max-size (the whole film "
        "is kept)",
        settings_.path.string(), settings_.codec->words, data_size_text(cap));
}

// Puts the film that was encoded anew in place of the film at its own quality.
void CappedFilm::take_fitted() const {
    const int code = replace_synced(work_.file(fitted), settings_.path);
    if (code < 0) throw RunError("{}: cannot be replaced: {}", settings_.path.string(), ffmpeg_error(code));
}

// CodecSettings::log for the second pass: the name of x264's file, or the text that libvpx gives.
std::string CappedFilm::first_pass() const {
    if (settings_.codec->film_is_first_pass) return work_.file("pass.log");
    CodecSettings settings = codec_settings(settings_);
    settings.pass = 1;
    settings.bit_rate = 1'000'000;  // has no effect in the first pass
    const OpenCodec codec = open_codec(*settings_.codec, settings);
    FilmReader spool(work_.file("spool.mkv"));
    const PacketPtr packet(av_packet_alloc());
    std::int64_t number = 0;
    for (AVFrame* frame = spool.next();; frame = spool.next()) {
        if (frame) frame->pts = number++;
        int code = avcodec_send_frame(codec.context.get(), frame);
        while (code >= 0) code = avcodec_receive_packet(codec.context.get(), packet.get());
        if (code != AVERROR(EAGAIN) && code != AVERROR_EOF)
            throw RunError("{}: the first pass failed: {}", settings_.path.string(), ffmpeg_error(code));
        if (!frame) break;
    }
    return codec.context->stats_out ? codec.context->stats_out : "";
}

std::int64_t CappedFilm::encode(EncoderSettings settings) const {
    settings.path = work_.file(fitted);
    Encoder encoder(settings);
    FilmReader spool(work_.file("spool.mkv"));
    while (AVFrame* frame = spool.next()) encoder.add(*frame);
    encoder.finish();
    return size_of(settings.path);
}

std::int64_t CappedFilm::encode_legible() const {
    EncoderSettings settings = settings_;
    settings.quality = least_legible;
    return encode(settings);
}

std::int64_t CappedFilm::encode_at(std::int64_t bit_rate, const std::string& log) const {
    EncoderSettings settings = settings_;
    settings.pass = 2;
    settings.bit_rate = bit_rate;
    settings.log = log;
    return encode(settings);
}

std::string CappedFilm::description() const {
    return result_.empty() ? description_ : description_ + "; " + result_;
}

namespace {

// Finds one palette for the whole film. With a palette for each frame, things that stand still would flicker.
AvFramePtr find_palette(const std::filesystem::path& spool, int colours) {
    FilmReader reader(spool);
    FilterGraph graph(reader.codec(), fmt::format("palettegen=max_colors={}", colours));
    while (AVFrame* frame = reader.next()) graph.push(*frame);
    graph.end();
    AvFramePtr palette = graph.pull();
    if (!palette) throw RunError("film: no colours were found for the GIF");
    return palette;
}

// Encodes the GIF. Bayer's dither pattern depends on the place alone, so it does not crawl from frame to
// frame, and what stands still costs no bytes.
void encode(const std::filesystem::path& spool, const AVFrame& palette, const char* dither, Encoder& gif) {
    FilmReader reader(spool);
    FilterGraph graph(reader.codec(), fmt::format("paletteuse=dither={}:diff_mode=rectangle", dither),
                      &palette);
    while (AVFrame* frame = reader.next()) {
        graph.push(*frame);
        while (const AvFramePtr picture = graph.pull()) gif.add(*picture);
    }
    graph.end();
    while (const AvFramePtr picture = graph.pull()) gif.add(*picture);
}

// Palettes of falling size. The grains' shades go first: with 32 colours the species still have their own.
constexpr std::array<GifColours, 4> palettes{{
    {256, "bayer:bayer_scale=3", "Bayer dither"},
    {128, "bayer:bayer_scale=4", "fine Bayer dither"},
    {64, "none", "no dither"},
    {32, "none", "no dither"},
}};

}  // namespace

GifFilm::GifFilm(const EncoderSettings& settings, std::optional<std::int64_t> cap)
    : settings_(settings),
      cap_(cap),
      work_(settings.path),
      spool_(std::make_unique<Encoder>(spool_settings(settings, spool_of_rgb(), work_))),
      description_(spool_->description()) {
    work_.keep();
}

// Writes the film in these colours and returns its size in bytes.
std::int64_t GifFilm::write(const GifColours& colours, const std::filesystem::path& path) {
    EncoderSettings settings = settings_;
    settings.path = path;
    Encoder gif(settings);
    description_ = fmt::format("{}, {} colours, {}", gif.description(), colours.count, colours.words);
    if (spool_->frames() > 0) {
        const std::filesystem::path spool = work_.file("spool.mkv");
        const AvFramePtr palette = find_palette(spool, colours.count);
        encode(spool, *palette, colours.dither, gif);
    }
    gif.finish();
    return static_cast<std::int64_t>(std::filesystem::file_size(path));
}

void GifFilm::take(const std::filesystem::path& made) {
    const int code = replace_synced(made, settings_.path);
    if (code < 0)
        throw RunError("{}: cannot be written: {}; {} plays", settings_.path.string(), ffmpeg_error(code),
                       work_.file("spool.mkv").string());
    work_.remove();
}

void GifFilm::finish() {
    spool_->finish();
    const std::filesystem::path best = work_.file("movie.gif"), smaller = work_.file("smaller.gif");
    const std::int64_t size = write(palettes.front(), best);
    if (!cap_ || size <= *cap_) return take(best);
    const std::string in_all_colours = description_;
    std::int64_t smallest = size;
    for (std::size_t i = 1; i < palettes.size(); ++i) {
        smallest = write(palettes[i], smaller);
        if (smallest <= *cap_) return take(smaller);
    }
    description_ = in_all_colours;
    take(best);
    const auto cap = static_cast<double>(*cap_), needed = static_cast<double>(smallest);
    throw RunError(
        "{}: a cap of {} is too small for this film, which has {} with the fewest colours. What "
        "fits: {}; or raise "
        "--max-size (the whole film is kept, {})",
        settings_.path.string(), data_size_text(cap), data_size_text(needed),
        smaller_film(settings_.width, settings_.height, spool_->frames(), cap / needed),
        data_size_text(static_cast<double>(size)));
}

}  // namespace grainreel
