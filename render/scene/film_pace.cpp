#include "render/scene/film_pace.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace grainreel {

std::string speed_words(double playback) {
    const double slower = 1 / playback;
    const double tenths = std::round(slower * 10) / 10;
    if (std::abs(slower - tenths) < 1e-9 * slower) return fmt::format("1/{:g}", tenths);
    if (slower >= 1000 && slower < 1e15) return fmt::format("1/{}", std::llround(slower));
    return fmt::format("{:.3g}", playback);
}

namespace {

std::string pace_words(const FilmSegment& segment, const Drive& drive, double film_rate, const Wording& say) {
    if (segment.kind == FilmSegment::Kind::motion) {
        if (segment.playback == 1) return say(Word::real_time);
        if (segment.playback > 1) return say(Word::time_lapse, {fmt::format("{:.4g}", segment.playback)});
        return say(Word::slow_motion, {speed_words(segment.playback)});
    }
    // With pictures on the way from one locked moment to the next, there are more frames than moments.
    const bool between = segment.between > 0;
    const std::string phase = fmt::format("{:.3g}", segment.phase);
    const std::string often =
        segment.every == 1
            ? say(between ? Word::moment_a_period : Word::frame_a_period, {phase})
            : say(between ? Word::moment_every : Word::frame_every, {std::to_string(segment.every), phase});
    if (drive.changes()) return often;
    const std::string pace =
        fmt::format("{:.4g}", film_rate * segment.every / ((segment.between + 1) * drive.frequency));
    return fmt::format("{} ({})", often, say(Word::plays, {pace}));
}

// Words for what each picture shows when it is not one moment.
std::string span_words(const FilmSegment& segment, const Wording& say) {
    if (segment.average == 1) return ", " + say(Word::mean_of_a_period);
    if (segment.average > 1) return ", " + say(Word::mean_of_periods, {std::to_string(segment.average)});
    if (segment.exposure > 0) return ", " + say(Word::exposed, {time_span_text(segment.exposure)});
    return "";
}

}  // namespace

std::vector<FilmSegment> segments_of(const Film& film) {
    return film.segments.empty() ? std::vector<FilmSegment>(1) : film.segments;
}

std::string playback_caption(const FilmSegment& segment, const Drive& drive, double film_rate,
                             const Wording& say) {
    return pace_words(segment, drive, film_rate, say) + span_words(segment, say);
}

FilmSegment spanning(FilmSegment segment, int periods) {
    segment.every = std::lcm(segment.every, periods);
    segment.average = (segment.average + periods - 1) / periods * periods;
    return segment;
}

std::vector<std::string> playback_captions(const Film& film, const Drive& drive) {
    std::vector<std::string> captions;
    for (const FilmSegment& segment : segments_of(film))
        for (const int periods : {1, 2})
            captions.push_back(playback_caption(spanning(segment, periods), drive, film.rate, film.wording));
    return captions;
}

std::string time_span_text(double seconds) {
    constexpr double hair = 1e-9, least_seconds = 0.1, least_milliseconds = 1e-4;
    const double size = seconds * (1 + hair);
    if (size >= least_seconds) return fmt::format("{:.3g} s", seconds);
    if (size >= least_milliseconds) return fmt::format("{:.3g} ms", 1e3 * seconds);
    return fmt::format("{:.3g} µs", 1e6 * seconds);
}

}  // namespace grainreel
