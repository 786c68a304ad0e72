#include "render/film/sources/choice.hpp"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

std::vector<Frame> chosen_moments(const RenderRequest& what, const FrameArchive& run) {
    constexpr double hair = 1e-9;  // s
    const std::vector<Frame>& moments = run.moments();
    const double from = what.from.value_or(moments.front().time) - hair;
    const double to = what.to.value_or(moments.back().time) + hair;
    std::vector<Frame> chosen;
    std::int64_t inside = 0;
    for (const Frame& moment : moments)
        if (moment.time >= from && moment.time <= to && inside++ % what.every.value_or(1) == 0)
            chosen.push_back(moment);
    if (chosen.empty())
        throw UserError(fmt::format("{}: no frame of the run lies there; they go from {:.6g} to {:.6g} s",
                                    what.from ? "--from" : "--to", moments.front().time,
                                    moments.back().time));
    return alike(chosen, run.periods());
}

std::vector<Frame> alike(const std::vector<Frame>& moments, int periods) {
    constexpr double room = 1e-6;  // periods
    std::vector<Frame> kept;
    for (const Frame& moment : moments) {
        const double behind = moment.cycles - moments.front().cycles;
        if (std::abs(behind - std::round(behind)) > room) return moments;
        if (std::llround(behind) % periods == 0) kept.push_back(moment);
    }
    return kept;
}

std::vector<std::string> single_moment_warnings(const FilmedScene& scene, const std::string& why) {
    std::vector<std::string> warnings;
    const std::vector<FilmSegment>& segments = scene.film.segments;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].average == 0 && segments[i].exposure == 0) continue;
        const char* const what = segments[i].average > 0 ? "average" : "exposure";
        warnings.push_back(fmt::format("{}: '{}' is left out: {}",
                                       scene.where(fmt::format("film.segment[{}].{}", i, what)), what, why));
    }
    return warnings;
}

std::vector<FilmSegment> of_single_moments(std::vector<FilmSegment> segments) {
    for (FilmSegment& segment : segments) segment.average = 0, segment.exposure = 0;
    return segments;
}

std::optional<std::string> periods_warning(const FilmedScene& scene, const FrameArchive& run) {
    if (run.periods() == 1 || scene.film.periods > 0) return std::nullopt;
    return fmt::format(
        "the bed repeats itself only every {0} periods of the drive: frames at one phase and "
        "displacements go by {0} periods; film.periods = 1 lets them go by one",
        run.periods());
}

}  // namespace grainreel
