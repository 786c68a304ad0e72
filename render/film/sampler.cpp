#include "render/film/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

std::vector<FilmSegment> segments_of(const Film& film) {
    return film.segments.empty() ? std::vector<FilmSegment>(1) : film.segments;
}

// Ends of the segments in simulated time, s; none beyond `total`.
std::vector<double> segment_ends(const std::vector<FilmSegment>& segments, double total) {
    double given = 0;
    for (const FilmSegment& s : segments) given += s.duration.value_or(0);
    const double left = std::max(0.0, total - given);
    std::vector<double> ends;
    double end = 0;
    for (const FilmSegment& s : segments) {
        end += s.duration.value_or(left);
        ends.push_back(std::min(end, total));
    }
    return ends;
}

// Collects the shots of one segment after another; a step that is not later than the last one taken is left
// out (slow motion finer than the step, or two segments that meet).
class Schedule {
  public:
    Schedule(const Film& film, const Clock& clock) : rate_(film.rate), clock_(clock) {}

    // Steps from the one nearest to `start` (s) up to, without, the step `stop`.
    void add_motion(int segment, double playback, double start, std::int64_t stop) {
        for (std::int64_t k = 0;; ++k) {
            const double time = start + static_cast<double>(k) * playback / rate_;
            const std::int64_t step = std::llround(time / clock_.step);
            if (step >= stop) return;
            add(step, segment);
        }
    }

    // Steps from `start` up to, without, `stop`.
    void add_locked(int segment, const FilmSegment& rule, std::int64_t start, std::int64_t stop) {
        const std::int64_t period = clock_.steps_per_period;
        const double turns = rule.phase - clock_.initial_phase;
        const std::int64_t at = std::llround((turns - std::floor(turns)) * static_cast<double>(period));
        const std::int64_t first = start + (((at - start) % period) + period) % period;
        for (std::int64_t step = first; step < stop; step += rule.every * period) add(step, segment);
    }

    std::vector<Shot> take() { return std::move(shots_); }

  private:
    void add(std::int64_t step, int segment) {
        if (shots_.empty() || step > shots_.back().step) shots_.push_back({step, segment});
    }

    double rate_;
    Clock clock_;
    std::vector<Shot> shots_;
};

// "1/10", "1/2.5" or "0.35": whichever a reader takes in at a glance.
std::string speed_words(double playback) {
    const double slower = 1 / playback;
    const double tenths = std::round(slower * 10) / 10;
    if (std::abs(slower - tenths) < 1e-9 * slower) return fmt::format("1/{:g}", tenths);
    return fmt::format("{:.3g}", playback);
}

std::string pace_words(const FilmSegment& segment, const Drive& drive, double film_rate) {
    if (segment.kind == FilmSegment::Kind::motion) {
        if (segment.playback == 1) return "real time";
        if (segment.playback > 1) return fmt::format("time lapse, {:.4g}× speed", segment.playback);
        return fmt::format("slow motion, {} speed", speed_words(segment.playback));
    }
    const std::string often =
        segment.every == 1 ? "a period" : fmt::format("every {} periods", segment.every);
    return fmt::format("1 frame {} at phase {:.3g} (plays {:.4g}×)", often, segment.phase,
                       film_rate * segment.every / drive.frequency);
}

// What each picture shows when it is not one moment.
std::string span_words(const FilmSegment& segment) {
    if (segment.average == 1) return ", mean of a period";
    if (segment.average > 1) return fmt::format(", mean of {} periods", segment.average);
    if (segment.exposure > 0) return fmt::format(", exposed for {:.3g} s", segment.exposure);
    return "";
}

}  // namespace

std::string playback_caption(const FilmSegment& segment, const Drive& drive, double film_rate) {
    return pace_words(segment, drive, film_rate) + span_words(segment);
}

std::vector<Shot> film_schedule(const Film& film, const Clock& clock, std::int64_t steps) {
    const std::vector<FilmSegment> segments = segments_of(film);
    const std::vector<double> ends = segment_ends(segments, clock.time(steps));
    Schedule schedule(film, clock);
    double start = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const bool last = i + 1 == segments.size();
        // A segment hands its last step on to the next one; only the last keeps it.
        const std::int64_t end = std::min<std::int64_t>(steps, std::llround(ends[i] / clock.step));
        const std::int64_t stop = last ? end + 1 : end;
        if (segments[i].kind == FilmSegment::Kind::motion) {
            schedule.add_motion(static_cast<int>(i), segments[i].playback, start, stop);
        } else if (clock.steps_per_period > 0) {
            schedule.add_locked(static_cast<int>(i), segments[i], std::llround(start / clock.step), stop);
        } else {
            throw UserError(
                fmt::format("film segment {} is locked to the drive's phase, but nothing is driven; "
                            "give the scene a drive, or make it a motion segment",
                            i + 1));
        }
        start = ends[i];
    }
    return schedule.take();
}

FilmSegment spanning(FilmSegment segment, int periods) {
    segment.every = std::lcm(segment.every, periods);
    segment.average = (segment.average + periods - 1) / periods * periods;
    return segment;
}

std::vector<std::int64_t> exposed_steps(const Shot& shot, const FilmSegment& segment, const Clock& clock,
                                        int periods) {
    std::vector<std::int64_t> steps;
    if (segment.exposure <= 0) return steps;
    // Locked pictures stay in phase: the shutter opens once a period at most.
    const bool locked = segment.kind == FilmSegment::Kind::locked && clock.steps_per_period > 0;
    const std::int64_t unit = locked ? periods * clock.steps_per_period : 1;
    const std::int64_t span = std::llround(segment.exposure / (clock.step * static_cast<double>(unit)));
    const std::int64_t count = std::min<std::int64_t>(segment.exposures, span);
    for (std::int64_t k = count - 1; k > 0; --k) {
        const double back = static_cast<double>(k) * static_cast<double>(span) / static_cast<double>(count);
        steps.push_back(shot.step - unit * std::llround(back));
    }
    return steps;
}

std::vector<std::int64_t> averaged_steps(const Shot& shot, const FilmSegment& segment, const Clock& clock,
                                         int periods) {
    constexpr std::int64_t a_period = 16;
    std::vector<std::int64_t> steps;
    const std::int64_t count = a_period * segment.average;
    if (count == 0 || clock.steps_per_period == 0) return steps;
    const std::int64_t span = spanning(segment, periods).average * clock.steps_per_period;
    const double spacing = static_cast<double>(span) / static_cast<double>(count);
    for (std::int64_t k = count; k >= 0; --k)
        steps.push_back(shot.step - std::llround(static_cast<double>(k) * spacing));
    return steps;
}

double poster_time(const Film& film, double duration) {
    const std::vector<FilmSegment> segments = segments_of(film);
    const std::vector<double> ends = segment_ends(segments, duration);
    for (std::size_t i = segments.size(); i-- > 0;)
        if (segments[i].kind == FilmSegment::Kind::locked) return ends[i];
    return 0.8 * ends.back();
}

double apparent_frequency(double frequency, double frames) {
    return std::abs(frequency - std::round(frequency / frames) * frames);
}

std::vector<std::string> strobe_warnings(const Film& film, const Drive& drive) {
    std::vector<std::string> warnings;
    if (!drive.present || drive.frequency <= 0) return warnings;
    const double f = drive.frequency;
    const std::vector<FilmSegment> segments = segments_of(film);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].kind == FilmSegment::Kind::locked) continue;
        const double frames = film.rate / segments[i].playback;  // per simulated second
        // A hair of tolerance: exactly 8 frames a period must not warn for rounding.
        if (frames >= least_frames_a_period * f * (1 - 1e-12)) continue;
        warnings.push_back(fmt::format(
            "film segment {} shows {:.3g} frames a period: the {:.4g} Hz drive will seem to move "
            "at {:.4g} Hz; "
            "lock it to a phase, or set its playback to {:.3g} or less",
            i + 1, frames / f, f, apparent_frequency(f, frames), film.rate / (least_frames_a_period * f)));
    }
    return warnings;
}

}  // namespace grainreel
