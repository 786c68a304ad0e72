// Chooses the steps that become frames of the film.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "render/scene/film_pace.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// When a picture of the film is due: at `step`, under the rule of segment `segment`.
struct Due {
    std::int64_t step = 0;
    int segment = 0;
};

// The segment as it is played: if it asks for frames that lie closer than the steps, it gets one frame a
// step.
FilmSegment played(FilmSegment segment, double film_rate, const Clock& clock);
// The caption of a picture that was taken by a segment while the bed repeated itself after `periods` periods.
std::string pace_caption(const FilmSegment& segment, int periods, const Drive& drive, double film_rate,
                         const Clock& clock, const Wording& say = {});
// A warning for each segment that, played one frame a step, is faster than its playback says.
std::vector<std::string> pace_warnings(const FilmedScene& scene, const Clock& clock);

// How many shots a segment makes at most: motion may round two shots to one step.
struct SegmentCount {
    std::int64_t shots = 0;
    std::int64_t moments_a_shot = 0;  // earlier steps over which each shot is exposed or averaged
    // How many of these steps a shot is exposed over. A film draws them, but not those of a mean.
    std::int64_t exposures_a_shot = 0;
};

// Counts the shots of each segment by formulas, without making them. Throws UserError when a segment is
// locked but the clock has no periods.
std::vector<SegmentCount> count_film(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// Makes the shots, in strictly rising order of step, from step 0 to `steps`. Motion segments sample evenly in
// simulated time (rounded to the nearest step); locked ones take one step every `every` periods at `phase`.
// Segments follow each other without a gap; the one without a duration takes the time that the others leave.
// Without segments there is one in real time. The film ends with its segments when they end before `steps`.
// Throws UserError when count_film does, and also, before anything is made, when the film would have too many
// shots (check_schedule).
std::vector<Due> film_schedule(const FilmedScene& scene, const Clock& clock, std::int64_t steps);

// The earlier steps over which the picture at `shot` is exposed, rising; its own step is not among them. They
// may lie before the run. In motion they lie evenly over the exposure. In locked segments they lie whole
// periods apart, or whole multiples of `periods` where the bed repeats itself after that many. Empty without
// an exposure.
std::vector<std::int64_t> exposed_steps(const Due& shot, const FilmSegment& segment, const Clock& clock,
                                        int periods = 1);

// The steps over which the mean of the picture at `shot` is taken, rising. There are 16 evenly spaced ones
// for each period of `average`, and the last of them is the shot's own step. Before them stands the step at
// which the first period begins. If the bed repeats itself after `periods` periods, the steps are spread over
// the next multiple of `periods`. They may lie before the run. Empty without a mean.
std::vector<std::int64_t> averaged_steps(const Due& shot, const FilmSegment& segment, const Clock& clock,
                                         int periods = 1);

// A picture between two locked ones shows the grains on the straight way from one to the other. It is taken
// one or a few steps before the later one, at its phase but for these steps.
struct Way {
    std::int64_t from = 0;  // step of the earlier locked moment; it may lie before the run
    double share = 0;       // of the way, between 0 and 1
};
// The way that the picture at `shot` shows; empty where it shows a locked moment itself, or motion. If the
// bed repeats itself after `periods` periods, a whole multiple of them lies between the two locked moments.
std::optional<Way> way_between(const Due& shot, const FilmSegment& segment, const Clock& clock,
                               int periods = 1);
// How many steps before its locked moment such a picture is taken; 0 for all other pictures.
std::int64_t steps_ahead(const Due& shot, const FilmSegment& segment, const Clock& clock);

// Time of the frame that stands for the whole film, in s of simulated time from the film's start. It is the
// end of the last locked segment, since the result shows there at a known phase; without such a segment it is
// 0.8 of the film, or 0.4 where grains flow out.
double poster_time(const Film& film, double duration);

// With fewer frames in a period the eye cannot follow the motion of the drive.
constexpr double least_frames_a_period = 8;

// The frequency in Hz at which a motion of `frequency` (Hz) seems to go in a film with F = `frames` frames
// for each simulated second: |f - k F|, where k is the whole number nearest to f / F.
double apparent_frequency(double frequency, double frames);

// A warning, with the apparent frequency, for each segment that is not locked and shows fewer than
// least_frames_a_period frames a period. duration: of the run, s.
std::vector<std::string> strobe_warnings(const Film& film, const Drive& drive, double duration);

}  // namespace grainreel
