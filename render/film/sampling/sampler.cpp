#include "render/film/sampling/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr std::int64_t means_a_period = 16;
constexpr double rounding_of_cycles = 1e-9;
constexpr double longest_exposure = 9e15;  // steps; up to there a double counts exactly

// Ends of the segments in simulated time, s; none lies beyond `total`.
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

// The shots of one segment, described without making them: they lie at first + k spacing, k = 0, 1, ...
struct Stretch {
    int segment = 0;
    double start = 0;        // s, where the segment begins; for motion
    double frame = 0;        // s of simulated time for each frame; for motion
    std::int64_t first = 0;  // step
    // Steps between shots. 0: the shots lie at the steps nearest to start + k frame, or `periods` apart.
    std::int64_t every = 0;
    double cycles = 0;       // cycles at the first shot; for segments locked to a drive that changes
    int periods = 0;         // periods between shots of a locked segment; else 0
    int between = 0;         // pictures between two shots of a locked segment
    std::int64_t stop = 0;   // first step behind the segment
    std::int64_t count = 0;  // number of shots, at most: motion may round two to one step
};

// With a spacing below half a step, every step is the nearest one to some frame's time.
bool takes_every_step(double spacing) {
    return spacing < 0.5;
}

Stretch motion_stretch(double playback, double rate, double start, std::int64_t stop, const Clock& clock) {
    Stretch stretch;
    stretch.start = start;
    stretch.frame = playback / rate;
    stretch.first = std::llround(start / clock.step);
    stretch.stop = stop;
    const double spacing = stretch.frame / clock.step;
    if (takes_every_step(spacing)) stretch.every = 1;
    const std::int64_t steps = std::max<std::int64_t>(0, stop - stretch.first);
    const double reach = static_cast<double>(stop) - 0.5 - start / clock.step;
    const double frames = takes_every_step(spacing) ? static_cast<double>(steps) : reach / spacing + 1;
    stretch.count =
        steps == 0 || frames > static_cast<double>(steps) ? steps : static_cast<std::int64_t>(frames);
    return stretch;
}

// A drive that changes has periods of several lengths: shots are counted by them, not by steps.
Stretch changing_stretch(const FilmSegment& rule, std::int64_t start, std::int64_t stop, const Clock& clock) {
    const double turns = rule.phase - clock.initial_phase, at = turns - std::floor(turns);
    Stretch stretch;
    stretch.periods = rule.every;
    stretch.cycles = at + std::max(0.0, std::ceil(clock.cycles(start) - at - rounding_of_cycles));
    if (clock.step_at(stretch.cycles) < start) ++stretch.cycles;
    stretch.first = clock.step_at(stretch.cycles);
    stretch.stop = stop;
    if (stretch.first >= stop) return stretch;
    const auto step_of = [&](std::int64_t k) {
        return clock.step_at(stretch.cycles + static_cast<double>(k * rule.every));
    };
    stretch.count = static_cast<std::int64_t>((clock.cycles(stop) - stretch.cycles) / rule.every);
    while (step_of(stretch.count) < stop) ++stretch.count;
    while (step_of(stretch.count - 1) >= stop) --stretch.count;
    return stretch;
}

Stretch locked_stretch(const FilmSegment& rule, std::int64_t start, std::int64_t stop, const Clock& clock) {
    if (!clock.changes.empty()) return changing_stretch(rule, start, stop, clock);
    const std::int64_t period = clock.steps_per_period;
    const double turns = rule.phase - clock.initial_phase;
    const std::int64_t at = std::llround((turns - std::floor(turns)) * static_cast<double>(period));
    Stretch stretch;
    stretch.first = start + (((at - start) % period) + period) % period;
    stretch.every = rule.every * period;
    stretch.stop = stop;
    stretch.count = stretch.first < stop ? (stop - 1 - stretch.first) / stretch.every + 1 : 0;
    return stretch;
}

// Describes the shots of all segments. Throws UserError when a segment is locked but the clock has no
// periods.
std::vector<Stretch> stretches_of(const FilmedScene& scene, const Clock& clock, std::int64_t steps) {
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    const std::vector<double> ends = segment_ends(segments, clock.time(steps));
    std::vector<Stretch> stretches;
    double start = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const bool last = i + 1 == segments.size();
        // The step at which two segments meet belongs to the later one.
        const std::int64_t end = std::min<std::int64_t>(steps, std::llround(ends[i] / clock.step));
        const std::int64_t stop = last ? end + 1 : end;
        if (segments[i].kind == FilmSegment::Kind::motion) {
            stretches.push_back(motion_stretch(segments[i].playback, scene.film.rate, start, stop, clock));
        } else if (clock.steps_per_period > 0) {
            stretches.push_back(locked_stretch(segments[i], std::llround(start / clock.step), stop, clock));
        } else {
            throw UserError(
                "{}: film segment {} is locked to the drive's phase, but nothing is driven; "
                "give the scene a drive, or make it a motion segment",
                scene.where(fmt::format("film.segment[{}]", i)), i + 1);
        }
        Stretch& stretch = stretches.back();
        stretch.segment = static_cast<int>(i);
        if (segments[i].kind == FilmSegment::Kind::locked) stretch.between = segments[i].between;
        if (stretch.count > 0) stretch.count += (stretch.count - 1) * stretch.between;
        start = ends[i];
    }
    return stretches;
}

// Makes the shots. A step that is not later than the last one taken is left out (in slow motion finer than
// the step, or where two segments meet).
void make(const Stretch& stretch, const Clock& clock, std::vector<Due>& shots) {
    for (std::int64_t k = 0;; ++k) {
        double at = static_cast<double>(stretch.first + k * stretch.every);
        if (stretch.periods > 0)
            at =
                static_cast<double>(clock.step_at(stretch.cycles + static_cast<double>(k * stretch.periods)));
        else if (stretch.every == 0)
            at = (stretch.start + static_cast<double>(k) * stretch.frame) / clock.step;
        if (at >= static_cast<double>(stretch.stop) - 0.5) return;
        const std::int64_t step = std::llround(at);
        for (std::int64_t ahead = k > 0 ? stretch.between : 0; ahead >= 0; --ahead)
            if (shots.empty() || step - ahead > shots.back().step)
                shots.push_back({step - ahead, stretch.segment});
    }
}

// Locked pictures stay in phase: their shutter opens once a period at most.
bool stays_in_phase(const FilmSegment& segment, const Clock& clock) {
    return segment.kind == FilmSegment::Kind::locked && clock.steps_per_period > 0;
}

// Steps from one opening of the shutter to the next: 1, or the steps of whole periods where pictures stay in
// phase.
double exposed_unit(const FilmSegment& segment, const Clock& clock, std::int64_t step, int periods = 1) {
    return stays_in_phase(segment, clock) ? periods * clock.period_at(step) : 1;
}

// How many such units the shutter of a segment is open.
std::int64_t exposed_span(const FilmSegment& segment, double unit, const Clock& clock) {
    const double span = segment.exposure / (clock.step * unit);
    return std::llround(std::min(span, longest_exposure / unit));
}

// The step that lies so many periods before `step`.
std::int64_t periods_before(std::int64_t step, double periods, const Clock& clock) {
    if (clock.changes.empty())
        return step - std::llround(periods * static_cast<double>(clock.steps_per_period));
    return clock.step_at(clock.cycles(step) - periods);
}

// Rounds up to three digits: a playback that is a little too small would cause the same warning again.
double rounded_up(double playback) {
    const double digit = std::pow(10, std::floor(std::log10(playback)) - 2);
    return std::ceil(playback / digit - 1e-9) * digit;
}

}  // namespace

FilmSegment played(FilmSegment segment, double film_rate, const Clock& clock) {
    const double slowest = film_rate * clock.step;
    const bool finer = segment.playback < slowest * (1 - 1e-9);
    if (segment.kind == FilmSegment::Kind::motion && finer) segment.playback = slowest;
    return segment;
}

std::string pace_caption(const FilmSegment& segment, int periods, const Drive& drive, double film_rate,
                         const Clock& clock, const Wording& say) {
    return playback_caption(played(spanning(segment, periods), film_rate, clock), drive, film_rate, say);
}

std::vector<std::string> pace_warnings(const FilmedScene& scene, const Clock& clock) {
    std::vector<std::string> warnings;
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const FilmSegment pace = played(segments[i], scene.film.rate, clock);
        if (pace.playback == segments[i].playback) continue;
        const std::string key = fmt::format("film.segment[{}].playback", i);
        warnings.push_back(fmt::format(
            "{}: a playback of {:.3g} wants frames closer than the steps of {:.3g} s: the film shows every "
            "step once and plays at {} speed; write {} = {:.3g}, or shorten run.step",
            scene.where(key), segments[i].playback, clock.step, speed_words(pace.playback), key,
            rounded_up(pace.playback)));
    }
    return warnings;
}

std::vector<SegmentCount> count_film(const FilmedScene& scene, const Clock& clock, std::int64_t steps) {
    const std::vector<FilmSegment> segments = segments_of(scene.film);
    std::vector<SegmentCount> counts;
    for (const Stretch& stretch : stretches_of(scene, clock, steps)) {
        const FilmSegment& rule = segments[counts.size()];
        SegmentCount count;
        count.shots = stretch.count;
        if (rule.exposure > 0) {
            const std::int64_t span = exposed_span(rule, exposed_unit(rule, clock, stretch.first), clock);
            count.moments_a_shot =
                std::max<std::int64_t>(0, std::min<std::int64_t>(rule.exposures, span) - 1);
            count.exposures_a_shot = count.moments_a_shot;
        } else if (rule.average > 0 && clock.steps_per_period > 0) {
            count.moments_a_shot = means_a_period * rule.average + 1;
        }
        counts.push_back(count);
    }
    return counts;
}

std::vector<Due> film_schedule(const FilmedScene& scene, const Clock& clock, std::int64_t steps) {
    check_schedule(scene, count_film(scene, clock, steps));
    std::vector<Due> shots;
    for (const Stretch& stretch : stretches_of(scene, clock, steps)) make(stretch, clock, shots);
    return shots;
}

std::vector<std::int64_t> exposed_steps(const Due& shot, const FilmSegment& segment, const Clock& clock,
                                        int periods) {
    std::vector<std::int64_t> steps;
    if (segment.exposure <= 0) return steps;
    const std::int64_t span = exposed_span(segment, exposed_unit(segment, clock, shot.step, periods), clock);
    const std::int64_t count = std::min<std::int64_t>(segment.exposures, span);
    for (std::int64_t k = count - 1; k > 0; --k) {
        const std::int64_t back =
            std::llround(static_cast<double>(k) * static_cast<double>(span) / static_cast<double>(count));
        steps.push_back(stays_in_phase(segment, clock)
                            ? periods_before(shot.step, static_cast<double>(periods * back), clock)
                            : shot.step - back);
    }
    return steps;
}

std::vector<std::int64_t> averaged_steps(const Due& shot, const FilmSegment& segment, const Clock& clock,
                                         int periods) {
    std::vector<std::int64_t> steps;
    const std::int64_t count = means_a_period * segment.average;
    if (count == 0 || clock.steps_per_period == 0) return steps;
    const double spacing =
        static_cast<double>(spanning(segment, periods).average) / static_cast<double>(count);
    for (std::int64_t k = count; k >= 0; --k)
        steps.push_back(periods_before(shot.step, static_cast<double>(k) * spacing, clock));
    return steps;
}

std::int64_t steps_ahead(const Due& shot, const FilmSegment& segment, const Clock& clock) {
    if (segment.between == 0 || !stays_in_phase(segment, clock)) return 0;
    const double turns = segment.phase - clock.initial_phase, offset = turns - std::floor(turns);
    const double periods = std::round(clock.cycles(shot.step) - offset);
    const std::int64_t ahead = clock.step_at(periods + offset) - shot.step;
    return ahead > 0 && ahead <= segment.between ? ahead : 0;
}

std::optional<Way> way_between(const Due& shot, const FilmSegment& segment, const Clock& clock, int periods) {
    const std::int64_t ahead = steps_ahead(shot, segment, clock);
    if (ahead == 0) return std::nullopt;
    const double apart = spanning(segment, periods).every;
    return Way{periods_before(shot.step + ahead, apart, clock),
               1 - static_cast<double>(ahead) / (segment.between + 1)};
}

double poster_time(const Film& film, double duration) {
    constexpr double late = 0.8, while_it_flows = 0.4;  // of the film; late in it a hopper is empty
    const std::vector<FilmSegment> segments = segments_of(film);
    const std::vector<double> ends = segment_ends(segments, duration);
    for (std::size_t i = segments.size(); i-- > 0;)
        if (segments[i].kind == FilmSegment::Kind::locked) return ends[i];
    return (film.shows.outflow ? while_it_flows : late) * ends.back();
}

double apparent_frequency(double frequency, double frames) {
    return std::abs(frequency - std::round(frequency / frames) * frames);
}

namespace {

// The highest frequency of the drive in Hz between two times in s.
double highest_frequency(const Drive& drive, double from, double to) {
    if (!drive.changes()) return drive.frequency;
    const DriveSchedule schedule(drive);
    double highest = 0;
    for (std::size_t i = schedule.times().index_at(from); i < schedule.pieces().size(); ++i) {
        const DriveSchedule::Piece& piece = schedule.pieces()[i];
        if (schedule.times().stretches()[i].start >= to) break;
        if (piece.kind != DriveStage::Kind::rest)
            highest = std::max({highest, piece.frequency_before, piece.frequency});
    }
    return highest;
}

}  // namespace

std::vector<std::string> strobe_warnings(const Film& film, const Drive& drive, double duration) {
    std::vector<std::string> warnings;
    if (!drive.present || drive.frequency <= 0) return warnings;
    const std::vector<FilmSegment> segments = segments_of(film);
    const std::vector<double> ends = segment_ends(segments, duration);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].kind == FilmSegment::Kind::locked) continue;
        const double f = highest_frequency(drive, i > 0 ? ends[i - 1] : 0, ends[i]);
        const double frames = film.rate / segments[i].playback;  // for each simulated second
        // A small tolerance keeps rounding from causing a warning at exactly 8 frames a period.
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
