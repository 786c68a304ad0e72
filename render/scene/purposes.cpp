#include "render/scene/purposes.hpp"

#include <fmt/format.h>

#include "render/scene/film.hpp"

namespace grainreel {

const std::vector<Purpose>& purposes() {
    constexpr std::int64_t MB = 1'000'000;
    static const std::vector<Purpose> all{
        {"talk", 1920, 1080, 30, FilmFormat::mp4, 18, "fast", {}, {0, 0}},
        // What every publisher takes: IOP H.264 up to 10 MB, Elsevier up to 720 lines and from 15 frames/s.
        {"journal", 1280, 720, 25, FilmFormat::mp4, 18, "slow", 10 * MB, {0, 0}},
        {"web", 1280, 720, 30, FilmFormat::mp4, 23, "medium", {}, {0, 0}},
        // Stills for print: 3840 pixels are 33 cm at 300 dpi.
        {"poster", 3840, 2160, 5, FilmFormat::png, 18, "veryfast", {}, {4, 3}},
        {"4k", 3840, 2160, 30, FilmFormat::mp4, 20, "fast", {}, {0, 0}},
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
