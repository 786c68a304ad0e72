// Film: picture, camera, and which stretches of time it shows.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/scene/film/colours.hpp"
#include "engine/scene/text/reader_parts.hpp"

namespace grainreel {
namespace {

constexpr std::int64_t least_pixels = 64, most_pixels = 8192;
constexpr std::int64_t most_tiles = 12;  // of a contact sheet, each way

// "1920x1080" or [1920, 1080]; zeros for what is neither.
std::array<std::int64_t, 2> two_counts(Document& document, const char* path) {
    std::array<std::int64_t, 2> size{0, 0};
    if (document.is_array(path)) {
        size = document.two_integers(path).value_or(size);
    } else if (document.is_text(path)) {
        const std::optional<std::string> text = document.text(path);
        const char* end = text->data() + text->size();
        const auto width = std::from_chars(text->data(), end, size[0]);
        if (width.ptr != end && *width.ptr == 'x') {
            const auto height = std::from_chars(width.ptr + 1, end, size[1]);
            if (height.ptr != end) size[1] = 0;
        }
    }
    return size;
}

void read_size(Document& document, Film& film) {
    const char* path = "film.size";
    if (!document.has(path)) return;
    const std::array<std::int64_t, 2> size = two_counts(document, path);
    const auto wrong = [](std::int64_t pixels) { return pixels < least_pixels || pixels > most_pixels; };
    if (wrong(size[0]) || wrong(size[1]))
        document.fail(path,
                      fmt::format("must be width x height, each from {} to {} pixels, but is {}; write for "
                                  "example \"1920x1080\"",
                                  least_pixels, most_pixels, document.written_value(path)));
    film.width = static_cast<int>(size[0]);
    film.height = static_cast<int>(size[1]);
}

void read_sheet(Document& document, Film& film) {
    const char* path = "film.sheet";
    if (!document.has(path)) return;
    const std::array<std::int64_t, 2> sheet = two_counts(document, path);
    const auto wrong = [](std::int64_t count) { return count < 1 || count > most_tiles; };
    if (wrong(sheet[0]) || wrong(sheet[1]))
        document.fail(
            path,
            fmt::format("must be columns x rows, each from 1 to {}, but is {}; write for example \"4x3\"",
                        most_tiles, document.written_value(path)));
    film.sheet = {static_cast<int>(sheet[0]), static_cast<int>(sheet[1])};
}

void read_span(Document& document, const Scene& scene, const std::string& table, FilmSegment& segment) {
    const std::string average = table + ".average", exposure = table + ".exposure";
    if (const auto periods = document.integer(average)) {
        if (!scene.drive.present)
            document.fail(average,
                          "counts periods of the drive, but nothing oscillates; add [drive] or leave it");
        document.refuse(exposure, "a mean over periods has no shutter; keep one of the two");
        segment.average = static_cast<int>(*periods);
    }
    segment.exposure = document.quantity(exposure).value_or(segment.exposure);
    if (segment.exposure == 0) document.refuse(table + ".exposures", "they are moments of an 'exposure'");
    segment.exposures = static_cast<int>(document.integer(table + ".exposures").value_or(segment.exposures));
}

FilmSegment read_segment(Document& document, const Scene& scene, const std::string& table) {
    using Kind = FilmSegment::Kind;
    FilmSegment segment;
    segment.kind = chosen<Kind>(document, table + ".kind",
                                {{"motion", Kind::motion}, {"locked", Kind::locked}}, Kind::motion);
    segment.duration = document.quantity(table + ".duration");
    read_span(document, scene, table, segment);
    if (segment.kind == Kind::motion) {
        document.refuse(table + ".every", "a segment in motion has a 'playback'");
        document.refuse(table + ".phase", "a segment in motion shows every phase");
        segment.playback = document.quantity(table + ".playback").value_or(segment.playback);
        return segment;
    }
    document.refuse(table + ".playback", "a locked segment has 'every' and 'phase'");
    if (!scene.drive.present)
        document.fail(table + ".kind",
                      "is \"locked\", but nothing oscillates; add [drive] or write \"motion\"");
    segment.every = static_cast<int>(document.integer(table + ".every").value_or(segment.every));
    if (segment.every == 3) document.fail(table + ".every", "must be 1, 2 or 4, but is 3; write 2 or 4");
    segment.phase = document.quantity(table + ".phase").value_or(segment.phase);
    return segment;
}

// Without segments in the scene: slow motion at both ends, 4 s of film each but a tenth of the run at most,
// and one frame a period between. Slow enough for 8 frames a period and for no more than three periods a
// second of film, which would flash; or ten times slower if that is slower.
std::vector<FilmSegment> default_segments(const Scene& scene) {
    FilmSegment motion;
    if (!scene.drive.present) return {motion};
    motion.playback =
        std::min({0.1, scene.film.rate / (8 * scene.drive.frequency), 3 / scene.drive.frequency});
    motion.duration = std::min(4 * motion.playback, 0.1 * scene.run.duration);
    FilmSegment between;
    between.kind = FilmSegment::Kind::locked;
    return {motion, between, motion};
}

// The durations that are given must fit in the run. A run made shorter on the command line shortens them too:
// to half of the run when a segment takes the rest, else to all of it.
void fit_segments(Document& document, Scene& scene) {
    double given = 0;
    std::size_t open = 0;
    for (std::size_t i = 0; i < scene.film.segments.size(); ++i) {
        const FilmSegment& segment = scene.film.segments[i];
        given += segment.duration.value_or(0);
        if (!segment.duration && ++open > 1)
            document.fail(
                fmt::format("film.segment[{}].duration", i),
                "is missing, and of an earlier segment too; only one may take what the others leave");
    }
    const double duration = scene.run.duration;
    const double room = duration * (1 + 1e-9);  // rounding of sums
    if (open > 0 ? given < duration : given <= room) return;
    if (!document.from_command_line("run.duration"))
        document.fail("film.segment",
                      fmt::format("shows {:.6g} s{}, but the run has {:.6g} s; shorten the segments or "
                                  "lengthen run.duration",
                                  given, open > 0 ? " and more" : "", duration));
    const double scale = (open > 0 ? 0.5 : 1.0) * duration / given;
    for (FilmSegment& segment : scene.film.segments)
        if (segment.duration) *segment.duration *= scale;
}

}  // namespace

void read_film(Document& document, Scene& scene) {
    Film& film = scene.film;
    take_purpose(document, film);
    read_size(document, film);
    film.rate = document.quantity("film.rate").value_or(film.rate);
    film.title = document.text("film.title").value_or(scene.title);
    read_sheet(document, film);
    read_film_file(document, scene);
    read_film_look(document, film);
    if (const auto text = document.text("film.background")) {
        const auto colour = parse_colour(*text);
        if (!colour)
            document.fail(
                "film.background",
                fmt::format("must be a colour, but is {}; write for example \"white\" or \"#ffffff\"",
                            document.written_value("film.background")));
        film.background = *colour;
    }
    read_camera(document, film);
    for (std::size_t i = 0; i < document.size("film.segment"); ++i)
        film.segments.push_back(read_segment(document, scene, fmt::format("film.segment[{}]", i)));
    if (film.segments.empty()) film.segments = default_segments(scene);
    fit_segments(document, scene);
    film.periods = static_cast<int>(document.integer("film.periods").value_or(film.periods));
    read_shows(document, scene);
}

}  // namespace grainreel
