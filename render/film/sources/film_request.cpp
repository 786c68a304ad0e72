#include "render/film/sources/film_request.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double usual_dpi = 300;  // what journals ask for

}  // namespace

double dots_an_inch(const PrintSize& print) {
    return print.dpi.value_or(print.width_mm || print.pdf ? usual_dpi : 0);
}

void fit_to_paper(Film& film, const PrintSize& print) {
    if (!print.width_mm) return;
    constexpr double inch = 25.4;  // mm
    constexpr double most = 16384;
    const double width = std::round(*print.width_mm / inch * dots_an_inch(print));
    const double height = std::round(width * film.height / film.width);
    if (width < 16 || height < 16 || width > most || height > most)
        throw UserError("--width-mm: {} mm at {} dpi are {} x {} pixels; a side has 16 to {}",
                        *print.width_mm, dots_an_inch(print), width, height, most);
    film.width = static_cast<int>(width);
    film.height = static_cast<int>(height);
}

ThreadPlan plan_threads(int processors, bool film, std::int64_t grains) {
    const int useful = useful_threads(processors, grains);
    if (!film) return {useful, 1, 1};
    // On one or two processors the engine and the film take turns with all of them; with more, the film gets
    // processors of its own.
    if (processors <= 2) return {std::min(useful, processors), 1, 1, true};
    const int share = std::max(1, processors / 6);
    return {std::min(useful, processors - processors / 3), share, share};
}

ThreadPlan drawing_threads(int wanted) {
    const int processors = wanted > 0 ? wanted : usable_processors();
    const int raster = std::max(1, processors / 2);
    return {0, raster, std::max(1, processors - raster)};
}

double time_of_cycle(const RenderRequest& what, const Clock& clock, double last) {
    if (clock.steps_per_period == 0) throw UserError("--cycle: the run has no drive; give --at TIME");
    const double cycles = *what.cycle + what.phase;
    const std::int64_t step = clock.step_at(cycles), end = std::llround(last / clock.step);
    if (step > end)
        throw UserError("--cycle: {:.6g} periods come after the run, which has {:.6g}", cycles,
                        clock.cycles(end));
    return clock.time(step);
}

void check_times(const RenderRequest& what, const StateArchive& run, double last) {
    if (what.from) run.check_time("--from", *what.from, last, run.usual_slack(*what.from));
    if (what.to) run.check_time("--to", *what.to, last, run.usual_slack(*what.to));
    if (what.from && what.to && *what.from > *what.to)
        throw UserError("--from: {:.6g} s is later than --to, {:.6g} s; exchange the two", *what.from,
                        *what.to);
}

std::vector<State> chosen_moments(const RenderRequest& what, const StateArchive& run) {
    const std::vector<State>& moments = run.moments();
    std::vector<State> chosen;
    for (const std::size_t k : run.between(what.from, what.to, what.every.value_or(1)))
        chosen.push_back(moments[k]);
    if (chosen.empty())
        throw UserError("{}: no frame of the run lies there; they go from {:.6g} to {:.6g} s",
                        what.from ? "--from" : "--to", moments.front().time, moments.back().time);
    return alike(chosen, run.periods());
}

std::vector<State> alike(const std::vector<State>& moments, int periods) {
    constexpr double room = 1e-6;  // tolerance, in periods
    std::vector<State> kept;
    for (const State& moment : moments) {
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

std::optional<std::string> periods_warning(const FilmedScene& scene, const StateArchive& run) {
    if (run.periods() == 1 || scene.film.periods > 0) return std::nullopt;
    return fmt::format(
        "the bed repeats itself only every {0} periods of the drive: frames at one phase and "
        "displacements go by {0} periods; film.periods = 1 lets them go by one",
        run.periods());
}

}  // namespace grainreel
