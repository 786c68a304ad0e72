// What of the film's file does not go with its format, and what must give way to it.
#include "render/scene/keys/film_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"

namespace grainreel {
namespace {

constexpr double gif_ticks = 100;         // a second: a GIF counts whole hundredths
constexpr double shortest_gif_ticks = 2;  // browsers slow down what asks for less

// The nearest of the rates that a GIF can have, 100/n frames a second.
double gif_rate(double wanted) {
    const double below = std::max(shortest_gif_ticks, std::ceil(gif_ticks / wanted));
    const double above = std::max(shortest_gif_ticks, below - 1);
    const double slow = gif_ticks / below, fast = gif_ticks / above;
    return wanted - slow <= fast - wanted ? slow : fast;
}

void fit_gif_rate(FilmedScene& scene) {
    Film& film = scene.film;
    const double rate = gif_rate(film.rate);
    if (std::abs(rate - film.rate) > 1e-9 * rate)
        scene.notes.push_back(
            fmt::format("{}: a GIF shows each frame for whole hundredths of a second: the "
                        "film gets {:.4g} frames/s in place of {:.4g}",
                        scene.where("film.rate"), rate, film.rate));
    film.rate = rate;
}

void check_max_size(const Document& document, const Film& film) {
    const char* path = "film.max_size";
    if (document.has(path) && film.max_size && !can_be_capped(film.format))
        document.fail(
            path, fmt::format("goes with the formats mp4, webm and gif, but the film is {}; remove it, or "
                              "write \"none\"",
                              word_of(film.format, film_format_words)));
}

void check_transparent(const Document& document, const Film& film) {
    if (film.transparent && film.format != FilmFormat::png && film.format != FilmFormat::ffv1)
        document.fail(
            "film.transparent",
            fmt::format("goes with the formats png and ffv1, but a film in {} keeps no alpha; write "
                        "format = \"png\"",
                        word_of(film.format, film_format_words)));
}

// A scene that names a size of its own keeps it; whoever asked for the purpose is to know.
void tell_what_stays(const Document& document, FilmedScene& scene) {
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

bool can_be_capped(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm || format == FilmFormat::gif;
}

void settle_film_file(const Document& document, FilmedScene& scene) {
    check_max_size(document, scene.film);
    check_transparent(document, scene.film);
    if (scene.film.format == FilmFormat::gif) fit_gif_rate(scene);
    tell_what_stays(document, scene);
}

}  // namespace grainreel
