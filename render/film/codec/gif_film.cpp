#include "render/film/codec/gif_film.hpp"

#include <fmt/format.h>

#include <array>

#include "engine/base/error.hpp"
#include "engine/scene/text/data_size.hpp"
#include "render/film/codec/film_reader.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/filter_graph.hpp"
#include "render/film/codec/remux.hpp"

namespace grainreel {
namespace {

EncoderSettings spool_settings(EncoderSettings settings, const WorkFolder& work) {
    settings.codec = &spool_of_rgb();
    settings.path = work.file("spool.mkv");
    return settings;
}

// One palette for the whole film: with one a frame, colours that stand still would flicker.
AvFramePtr find_palette(const std::filesystem::path& spool, int colours) {
    FilmReader reader(spool);
    FilterGraph graph(reader.codec(), fmt::format("palettegen=max_colors={}", colours));
    while (AVFrame* frame = reader.next()) graph.push(*frame);
    graph.end();
    AvFramePtr palette = graph.pull();
    if (!palette) throw RunError("film: no colours were found for the GIF");
    return palette;
}

// Bayer's pattern depends on nothing but the place: it does not crawl, and what stands still costs no bytes.
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
      spool_(std::make_unique<Encoder>(spool_settings(settings, work_))),
      description_(spool_->description()) {
    work_.keep();
}

// The film in these colours; its size in bytes.
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
        throw RunError(fmt::format("{}: cannot be written: {}; {} plays", settings_.path.string(),
                                   ffmpeg_error(code), work_.file("spool.mkv").string()));
    work_.remove();
}

void GifFilm::finish() {
    spool_->finish();
    const std::filesystem::path best = work_.file("movie.gif"), smaller = work_.file("smaller.gif");
    const std::int64_t size = write(palettes.front(), best);
    if (!cap_ || size <= *cap_) return take(best);
    const std::string in_all_colours = description_;
    std::int64_t least = size;
    for (std::size_t i = 1; i < palettes.size(); ++i) {
        least = write(palettes[i], smaller);
        if (least <= *cap_) return take(smaller);
    }
    description_ = in_all_colours;
    take(best);
    const auto cap = static_cast<double>(*cap_), needed = static_cast<double>(least);
    throw RunError(
        fmt::format("{}: a cap of {} is too small for this film, which has {} with the fewest colours. What "
                    "fits: {}; or raise "
                    "--max-size (the whole film is kept, {})",
                    settings_.path.string(), data_size_text(cap), data_size_text(needed),
                    smaller_film(settings_.width, settings_.height, spool_->frames(), cap / needed),
                    data_size_text(static_cast<double>(size))));
}

}  // namespace grainreel
