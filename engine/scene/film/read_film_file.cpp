// The film's file: what it is for, format, quality and size.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/film/purposes.hpp"
#include "engine/scene/text/data_size.hpp"
#include "engine/scene/text/reader_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

// A film under a cap is as good as the cap lets it be, up to this crf.
constexpr int capped_quality = 18;
constexpr double gif_ticks = 100;         // a second: a GIF counts whole hundredths
constexpr double shortest_gif_ticks = 2;  // browsers slow down what asks for less

// Of the rates that a GIF can have, 100/n frames a second, the nearest.
double gif_rate(double wanted) {
    const double below = std::max(shortest_gif_ticks, std::ceil(gif_ticks / wanted));
    const double above = std::max(shortest_gif_ticks, below - 1);
    const double slow = gif_ticks / below, fast = gif_ticks / above;
    return wanted - slow <= fast - wanted ? slow : fast;
}

void fit_gif_rate(Scene& scene) {
    Film& film = scene.film;
    const double rate = gif_rate(film.rate);
    if (std::abs(rate - film.rate) > 1e-9 * rate)
        scene.notes.push_back(
            fmt::format("{}: a GIF shows each frame for whole hundredths of a second: the "
                        "film gets {:.4g} frames/s in place of {:.4g}",
                        scene.where("film.rate"), rate, film.rate));
    film.rate = rate;
}

bool can_be_capped(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm || format == FilmFormat::gif;
}

void read_max_size(Document& document, Film& film) {
    const char* path = "film.max_size";
    const auto text = document.text(path);
    if (!text) return;
    const bool none = *text == "none";
    film.max_size = none ? std::nullopt : parse_data_size(*text);
    if (!none && !film.max_size)
        document.fail(path, fmt::format("must be a size in kB, MB, GB, KiB, MiB or GiB, but is {}; write "
                                        "for example \"10 MB\"",
                                        document.written_value(path)));
    if (film.max_size && !can_be_capped(film.format))
        document.fail(
            path, fmt::format("goes with the formats mp4, webm and gif, but the film is {}; remove it, or "
                              "write \"none\"",
                              word_of(film.format, film_format_words)));
}

void read_transparent(Document& document, Film& film) {
    const char* path = "film.transparent";
    film.transparent = document.flag(path).value_or(film.transparent);
    if (film.transparent && film.format != FilmFormat::png && film.format != FilmFormat::ffv1)
        document.fail(
            path, fmt::format("goes with the formats png and ffv1, but a film in {} keeps no alpha; write "
                              "format = \"png\"",
                              word_of(film.format, film_format_words)));
}

// A scene that names a size of its own keeps it; whoever asked for the purpose is to know.
void tell_what_stays(const Document& document, Scene& scene) {
    const Purpose* purpose = find_purpose(scene.film.purpose);
    if (purpose == nullptr) return;
    const Film& film = scene.film;
    std::vector<std::string> stays;
    if (film.width != purpose->width || film.height != purpose->height)
        stays.push_back(
            fmt::format("size {}x{} ({}x{})", film.width, film.height, purpose->width, purpose->height));
    if (film.rate != purpose->rate)
        stays.push_back(fmt::format("rate {:.4g} ({:.4g})", film.rate, purpose->rate));
    if (film.format != purpose->format)
        stays.push_back(fmt::format("format {} ({})", word_of(film.format, film_format_words),
                                    word_of(purpose->format, film_format_words)));
    if (!stays.empty())
        scene.notes.push_back(
            fmt::format("{}: what is set elsewhere stays, the default of \"{}\" in brackets: {}",
                        document.place("film.for"), purpose->name, fmt::join(stays, ", ")));
}

}  // namespace

void take_purpose(Document& document, Film& film) {
    const Purpose* purpose = find_purpose(document.text("film.for").value_or(""));
    if (purpose == nullptr) return;
    film.purpose = purpose->name;
    film.width = purpose->width;
    film.height = purpose->height;
    film.rate = purpose->rate;
    film.format = purpose->format;
    film.quality = purpose->quality;
    film.preset = purpose->preset;
    film.max_size = purpose->max_size;
    film.sheet = purpose->sheet;
}

void read_film_file(Document& document, Scene& scene) {
    Film& film = scene.film;
    film.format = chosen<FilmFormat>(document, "film.format", film_format_words, film.format);
    if (!can_be_capped(film.format)) film.max_size.reset();
    read_max_size(document, film);
    if (film.max_size) film.quality = capped_quality;
    film.quality = static_cast<int>(document.integer("film.quality").value_or(film.quality));
    film.preset = document.text("film.preset").value_or(film.preset);
    read_transparent(document, film);
    if (film.format == FilmFormat::gif) fit_gif_rate(scene);
    tell_what_stays(document, scene);
}

}  // namespace grainreel
