// Which steps become frames of the film.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// One frame of the film: taken at `step`, under the rule of segment `segment`.
struct Shot {
    std::int64_t step = 0;
    int segment = 0;
};

// The segments of a film; the usual one where the scene has none.
std::vector<FilmSegment> segments_of(const Film& film);

// What a frame's caption says of time: "real time", "slow motion, 1/10 speed" or
// "1 frame a period at phase 0.25 (plays 1.5×)". UTF-8.
std::string playback_caption(const FilmSegment& segment, const Drive& drive, double film_rate);

// How a segment plays where it asks for frames closer than the steps: with one frame a step.
FilmSegment played(FilmSegment segment, double film_rate, const Clock& clock);
// A line for each segment that therefore plays faster than its playback says.
std::vector<std::string> pace_warnings(const FilmedScene& scene, const Clock& clock);

// How much a segment makes, at most: motion may round two shots to one step.
struct SegmentCount {
    std::int64_t shots = 0;
    std::int64_t moments_a_shot = 0;    // earlier steps that each shot is exposed over or averaged from
    std::int64_t exposures_a_shot = 0;  // of them those that are drawn: the exposed
};

// One a segment, in closed form: nothing is made. Throws UserError when a segment is locked but the clock has
// no periods.
std::vector<SegmentCount> count_film(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// Shots in strictly rising order of step, from step 0 to `steps`. Motion segments sample evenly in simulated
// time (rounded to the nearest step); locked ones take one step every `every` periods at `phase`. Segments
// follow each other without a gap; the one without a duration takes what the others leave. No segments: one
// in real time. The segments' film ends with them when they are shorter than `steps`. Throws UserError when
// count_film does, and before anything is made when that is more than a film may have (check_schedule).
std::vector<Shot> film_schedule(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// How a segment is shown while the bed repeats itself after that many periods: its locked frames and means
// span whole multiples of them.
FilmSegment spanning(FilmSegment segment, int periods);

// The earlier steps that the picture at `shot` is exposed over besides its own, rising; they may lie before
// the run. In motion evenly over the exposure; locked ones lie whole periods apart, and where the bed repeats
// itself after `periods`, whole multiples of those. Empty without an exposure.
std::vector<std::int64_t> exposed_steps(const Shot& shot, const FilmSegment& segment, const Clock& clock,
                                        int periods = 1);

// The steps that the picture's mean is made of, rising: 16 for each period of `average`, the last of them the
// shot's own, and before them the one that closes the periods. They are spread over the next multiple of
// `periods`, after which the bed repeats itself. They may lie before the run. Empty without a mean.
std::vector<std::int64_t> averaged_steps(const Shot& shot, const FilmSegment& segment, const Clock& clock,
                                         int periods = 1);

// s of simulated time from the start of the film to the frame that stands for all of it: the end of the last
// locked segment, since there the result shows at a known phase; without one, 0.8 of the film.
double poster_time(const Film& film, double duration);

// Fewer, and the eye loses the drive's motion.
constexpr double least_frames_a_period = 8;

// Hz, at which a motion of `frequency` (Hz) seems to go in a film of F = `frames` a simulated second:
// |f - k F|, k being the whole number nearest to f / F.
double apparent_frequency(double frequency, double frames);

// One line for each segment that shows fewer frames a period than that without being locked, with the
// apparent frequency. duration: s, of the run.
std::vector<std::string> strobe_warnings(const Film& film, const Drive& drive, double duration);

}  // namespace grainreel
