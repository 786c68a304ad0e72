#include "render/film/gif_film.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/film_reader.hpp"
#include "render/film/filter_graph.hpp"
#include "render/film/remux.hpp"

namespace grainreel {
namespace {

EncoderSettings spool_settings(EncoderSettings settings, const WorkFolder& work) {
    settings.codec = &spool_of_rgb();
    settings.path = work.file("spool.mkv");
    return settings;
}

// One palette for the whole film: with one a frame, colours that stand still would flicker.
AvFramePtr find_palette(const std::filesystem::path& spool) {
    FilmReader reader(spool);
    FilterGraph graph(reader.codec(), "palettegen");
    while (AVFrame* frame = reader.next()) graph.push(*frame);
    graph.end();
    AvFramePtr palette = graph.pull();
    if (!palette) throw RunError("film: no colours were found for the GIF");
    return palette;
}

// Bayer's pattern depends on nothing but the place: it does not crawl, and what stands still costs no bytes.
void encode(const std::filesystem::path& spool, const AVFrame& palette, Encoder& gif) {
    FilmReader reader(spool);
    FilterGraph graph(reader.codec(), "paletteuse=dither=bayer:bayer_scale=3:diff_mode=rectangle", &palette);
    while (AVFrame* frame = reader.next()) {
        graph.push(*frame);
        while (const AvFramePtr picture = graph.pull()) gif.add(*picture);
    }
    graph.end();
    while (const AvFramePtr picture = graph.pull()) gif.add(*picture);
}

}  // namespace

GifFilm::GifFilm(const EncoderSettings& settings)
    : settings_(settings),
      work_(settings.path),
      spool_(std::make_unique<Encoder>(spool_settings(settings, work_))),
      description_(spool_->description()) {
    work_.keep();
}

void GifFilm::finish() {
    spool_->finish();
    EncoderSettings settings = settings_;
    settings.path = work_.file("movie.gif");
    Encoder gif(settings);
    description_ = gif.description();
    if (spool_->frames() > 0) {
        const std::filesystem::path spool = work_.file("spool.mkv");
        const AvFramePtr palette = find_palette(spool);
        encode(spool, *palette, gif);
    }
    gif.finish();
    const int code = replace_synced(settings.path, settings_.path);
    if (code < 0)
        throw RunError(fmt::format("{}: cannot be written: {}; {} plays", settings_.path.string(),
                                   ffmpeg_error(code), work_.file("spool.mkv").string()));
    work_.remove();
}

}  // namespace grainreel
