#include "render/film/sampling/timeline.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::int64_t nearest_step(double time, const Clock& clock, std::int64_t steps) {
    return std::clamp<std::int64_t>(std::llround(time / clock.step), 0, steps);
}

std::int64_t nearest_step_at(double phase, double time, const Clock& clock, std::int64_t steps) {
    const double turns = phase - clock.initial_phase;
    if (!clock.changes.empty()) {
        const double at = turns - std::floor(turns), cycles = clock.cycles(nearest_step(time, clock, steps));
        double nearest = at + std::max(0.0, std::round(cycles - at));
        if (clock.step_at(nearest) > steps) --nearest;
        return nearest < 0 ? nearest_step(time, clock, steps) : clock.step_at(nearest);
    }
    const auto period = static_cast<double>(clock.steps_per_period);
    const std::int64_t first = std::llround((turns - std::floor(turns)) * period) % clock.steps_per_period;
    const double periods = std::round((time / clock.step - static_cast<double>(first)) / period);
    std::int64_t step = first + static_cast<std::int64_t>(periods) * clock.steps_per_period;
    if (step < 0) step += clock.steps_per_period;
    if (step > steps) step -= clock.steps_per_period;
    return step < 0 ? nearest_step(time, clock, steps) : step;
}

}  // namespace

std::size_t reference_of(const std::vector<FilmedScene>& scenes) {
    std::size_t reference = 0;
    double longest = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const Drive& drive = scenes[i].drive;
        if (!drive.present || 1 / drive.frequency <= longest * (1 + 1e-9)) continue;
        longest = 1 / drive.frequency;
        reference = i;
    }
    return reference;
}

std::vector<Instant> instants_of(const FilmedScene& film, const Clock& reference, std::int64_t steps) {
    const std::vector<FilmSegment> segments = segments_of(film.film);
    std::vector<Instant> instants;
    for (const Due& shot : film_schedule(film, reference, steps))
        instants.push_back(
            {reference.time(shot.step), shot.segment,
             steps_ahead(shot, segments.at(static_cast<std::size_t>(shot.segment)), reference)});
    return instants;
}

std::vector<Due> shots_at(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments,
                          const Clock& clock, std::int64_t steps) {
    std::vector<Due> shots;
    for (const Instant& instant : instants) {
        const FilmSegment& rule = segments.at(static_cast<std::size_t>(instant.segment));
        const bool locked = rule.kind == FilmSegment::Kind::locked && clock.steps_per_period > 0;
        const std::int64_t step = locked ? nearest_step_at(rule.phase, instant.time, clock, steps)
                                         : nearest_step(instant.time, clock, steps);
        shots.push_back({std::max<std::int64_t>(0, step - instant.ahead), instant.segment});
    }
    // Where segments meet, a phase may lie a little before the moment shown last.
    for (std::size_t i = 1; i < shots.size(); ++i) shots[i].step = std::max(shots[i].step, shots[i - 1].step);
    return shots;
}

namespace {

// Phases (turns) and numbers of periods that differ by less than this count as equal. A step is at least 1e-7
// of a period.
constexpr double hair = 1e-9;

double mean_interval(const std::vector<State>& moments) {
    return (moments.back().time - moments.front().time) / static_cast<double>(moments.size() - 1);
}

bool even(const std::vector<State>& moments) {
    const double interval = mean_interval(moments);
    for (std::size_t i = 1; i < moments.size(); ++i)
        if (std::abs(moments[i].time - moments[i - 1].time - interval) > 1e-3 * interval) return false;
    return interval > 0;
}

// Distance of two phases in turns, the shorter way round.
double turn_between(double a, double b) {
    const double turns = a - b;
    return std::abs(turns - std::round(turns));
}

double half_a_step(const std::vector<State>& moments) {
    const auto steps = static_cast<double>(moments.back().step - moments.front().step);
    return steps > 0 ? 0.5 * (moments.back().time - moments.front().time) / steps : 0;
}

// Whether all moments are at one phase. Frames lie on steps, but a phase of a drive that changes may lie
// between two steps.
bool same_phase(const std::vector<State>& moments, const Drive& drive) {
    const double between_steps =
        drive.changes() ? 2.01 * half_a_step(moments) * drive.highest_frequency() : 0;
    return std::all_of(moments.begin(), moments.end(), [&](const State& moment) {
        return turn_between(moment.phase, moments.front().phase) < hair + between_steps;
    });
}

double mean_periods(const std::vector<State>& moments) {
    return (moments.back().cycles - moments.front().cycles) / static_cast<double>(moments.size() - 1);
}

// Whether the frames come one every so many periods. The periods may differ in length.
bool even_in_periods(const std::vector<State>& moments) {
    const double periods = mean_periods(moments);
    for (std::size_t i = 1; i < moments.size(); ++i)
        if (std::abs(moments[i].cycles - moments[i - 1].cycles - periods) > 0.1) return false;
    return periods > 0.5;
}

// The plain factor that was probably meant. Frames lie on steps, so the interval that was asked for is known
// to half a step at best, and a plain factor within that tolerance is taken.
double plain_factor(double playback, double tolerance) {
    for (const double parts : {1.0, 2.0}) {  // tries 1/2, 1/3 ..., then 1/2.5 and so on
        const double slower = std::round(parts / playback) / parts;
        if (slower >= 1 && std::abs(playback * slower - 1) <= tolerance) return 1 / slower;
    }
    const double faster = std::round(playback);
    return faster >= 1 && std::abs(playback / faster - 1) <= tolerance ? faster : playback;
}

}  // namespace

std::optional<FilmSegment> pacing_of(const std::vector<State>& moments, const Drive& drive, double rate) {
    if (moments.size() < 2) return std::nullopt;
    const bool locked = drive.present && same_phase(moments, drive) &&
                        (drive.changes() ? even_in_periods(moments) : even(moments));
    if (!locked && !even(moments)) return std::nullopt;
    FilmSegment segment;
    segment.duration = moments.back().time - moments.front().time;
    const double interval = mean_interval(moments);
    if (locked) {
        segment.kind = FilmSegment::Kind::locked;
        segment.every = static_cast<int>(
            std::lround(drive.changes() ? mean_periods(moments) : interval * drive.frequency));
        const double phase = std::round(moments.front().phase / hair) * hair;
        segment.phase = phase < 1 ? phase : 0;
        return segment;
    }
    segment.playback = plain_factor(interval * rate, half_a_step(moments) / interval + hair);
    return segment;
}

std::string pacing_caption(const std::vector<State>& moments, const Drive& drive, double rate,
                           const Wording& say) {
    if (moments.size() < 2) return {};
    if (const auto segment = pacing_of(moments, drive, rate))
        return playback_caption(*segment, drive, rate, say);
    const double interval = mean_interval(moments);
    if (interval <= 0) return {};
    if (drive.present && same_phase(moments, drive)) {
        const double periods = drive.changes() ? mean_periods(moments) : interval * drive.frequency;
        const std::string often = say(Word::frame_every, {fmt::format("{:.3g}", periods),
                                                          fmt::format("{:.3g}", moments.front().phase)});
        return fmt::format("{} ({})", say(Word::on_average, {often}),
                           say(Word::plays, {fmt::format("{:.3g}", interval * rate)}));
    }
    FilmSegment segment;
    segment.playback = std::round(interval * rate * 100) / 100 > 0 ? std::round(interval * rate * 100) / 100
                                                                   : interval * rate;
    return say(Word::on_average, {playback_caption(segment, drive, rate, say)});
}

std::optional<std::string> pacing_warning(const std::vector<State>& moments, const Drive& drive) {
    if (moments.size() < 2 || !drive.present || same_phase(moments, drive)) return std::nullopt;
    const double frames = 1 / mean_interval(moments),
                 f = drive.highest_frequency();  // both for each simulated second: frames, periods
    if (frames >= least_frames_a_period * f * (1 - hair)) return std::nullopt;
    return fmt::format(
        "{:.3g} frames a period are drawn: the {:.4g} Hz drive will seem to move at {:.4g} Hz; take one "
        "frame a "
        "period with --every, or run the scene with an output.trajectory_interval of {:.3g} s or less",
        frames / f, f, apparent_frequency(f, frames), 1 / (least_frames_a_period * f));
}

}  // namespace grainreel
