// The table of purposes with their defaults.
#include "render/scene/purposes.hpp"

#include <fmt/format.h>

#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

const std::vector<Purpose>& purposes() {
    constexpr std::int64_t MB = 1'000'000;
    static const std::vector<Purpose> all{
        {.name = "talk",
         .width = 1920,
         .height = 1080,
         .rate = 30,
         .format = FilmFormat::mp4,
         .quality = 18,
         .preset = "fast",
         .max_size = {},
         .sheet = {0, 0}},
        // A film that all publishers accept: IOP accepts H.264 up to 10 MB, Elsevier up to 720 lines and at
        // least 15 frames/s.
        {.name = "journal",
         .width = 1280,
         .height = 720,
         .rate = 25,
         .format = FilmFormat::mp4,
         .quality = 18,
         .preset = "slow",
         .max_size = 10 * MB,
         .sheet = {0, 0}},
        {.name = "web",
         .width = 1280,
         .height = 720,
         .rate = 30,
         .format = FilmFormat::mp4,
         .quality = 23,
         .preset = "medium",
         .max_size = {},
         .sheet = {0, 0}},
        // Stills for print: 3840 pixels are 33 cm at 300 dpi.
        {.name = "poster",
         .width = 3840,
         .height = 2160,
         .rate = 5,
         .format = FilmFormat::png,
         .quality = 18,
         .preset = "veryfast",
         .max_size = {},
         .sheet = {4, 3}},
        {.name = "4k",
         .width = 3840,
         .height = 2160,
         .rate = 30,
         .format = FilmFormat::mp4,
         .quality = 20,
         .preset = "fast",
         .max_size = {},
         .sheet = {0, 0}},
    };
    return all;
}

std::vector<std::string> purpose_names() {
    std::vector<std::string> names;
    for (const Purpose& purpose : purposes()) names.emplace_back(purpose.name);
    return names;
}

const Purpose* find_purpose(const std::string& name) {
    for (const Purpose& purpose : purposes())
        if (name == purpose.name) return &purpose;
    return nullptr;
}

std::vector<std::string> assignments_of(const Purpose& p) {
    std::vector<std::string> all{
        fmt::format("film.size={}x{}", p.width, p.height),
        fmt::format("film.rate={}", p.rate),
        fmt::format("film.format={}", word_of(p.format, film_format_words)),
        fmt::format("film.quality={}", p.quality),
        fmt::format("film.preset={}", p.preset),
        "film.max_size=" + (p.max_size ? fmt::format("{} B", *p.max_size) : std::string("none")),
    };
    if (p.sheet[0] > 0) all.push_back(fmt::format("film.sheet={}x{}", p.sheet[0], p.sheet[1]));
    return all;
}

}  // namespace grainreel
