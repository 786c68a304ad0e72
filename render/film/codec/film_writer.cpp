#include "render/film/codec/film_writer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/spooled_films.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

EncoderSettings encoder_settings(const FilmedScene& scene, const FilmWriterOptions& options) {
    EncoderSettings settings;
    settings.codec = &codec_of(scene.film.format);
    settings.path = options.to_stdout ? to_stdout : options.folder / film_file_name(scene.film.format);
    settings.width = scene.film.width;
    settings.height = scene.film.height;
    settings.rate = scene.film.rate;
    settings.quality = scene.film.quality;
    settings.preset = scene.film.preset;
    settings.alpha = scene.film.transparent;
    settings.threads = options.threads;
    settings.title = scene.film.title;
    settings.comment = fmt::format("grainreel, scene {}, seed {}", scene.name, scene.run.seed);
    return settings;
}

}  // namespace

void FilmWriter::begin_group() {
    throw RunError("film: a GIF, or a film with a cap on its size, is encoded as a whole");
}

std::string film_file_name(FilmFormat format) {
    return format == FilmFormat::png ? "" : fmt::format("movie.{}", codec_of(format).extension);
}

std::string left_film_name(FilmFormat format) {
    return format == FilmFormat::gif ? GifFilm::spool_name() : film_file_name(format);
}

std::unique_ptr<FilmWriter> make_film_writer(const FilmedScene& scene, const FilmWriterOptions& options) {
    if (scene.film.format == FilmFormat::png) return nullptr;
    const EncoderSettings settings = encoder_settings(scene, options);
    if (scene.film.format == FilmFormat::gif) return std::make_unique<GifFilm>(settings, scene.film.max_size);
    if (scene.film.max_size) return std::make_unique<CappedFilm>(settings, *scene.film.max_size);
    return std::make_unique<Encoder>(settings);
}

namespace {

constexpr double in_hand = 0.9, bytes_by_pixels = 0.7;
constexpr int least_height = 240;  // in lower pictures words are too small to be read
constexpr std::int64_t least_frames = 10;

int even_below(double pixels) {
    return 2 * static_cast<int>(pixels / 2);
}

}  // namespace

std::string smaller_film(int width, int height, std::int64_t frames, double share) {
    const double scale = std::min(1.0, std::pow(in_hand * share, 0.5 / bytes_by_pixels));
    const int lines = even_below(scale * height), columns = even_below(scale * width);
    const auto fewer = static_cast<std::int64_t>(in_hand * share * static_cast<double>(frames));
    std::string text;
    if (lines >= least_height) text = fmt::format("--size {}x{}", columns, lines);
    if (fewer >= least_frames)
        text += fmt::format(
            "{}{} of its {} frames (a shorter --duration, a lower --fps, or segments that show "
            "less)",
            text.empty() ? "" : ", or ", fewer, frames);
    return text.empty() ? "no smaller picture and no shorter film that shows anything" : text;
}

}  // namespace grainreel
