// The texts around a picture: numbers with their units, the drive, the time and the scene's own words.
// blocks.hpp and layout.hpp decide where they stand.
#pragma once

#include <string>
#include <vector>

#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The title that the frame shows; empty for none.
std::string shown_title(const Film& film);
// "5 mm", "1.25 cm", "320 µm": at most three digits, in the unit that suits the size.
std::string length_text(double metres);
// "20 Hz", "1.5 kHz".
std::string frequency_text(double hertz);
// "t = 3.250 s"; in ms where the whole run lasts less than 0.1 s.
std::string time_text(double seconds, double duration);
// "5 mm" or, for a spread, "4–6 mm".
std::string diameter_text(const SizeSpread& diameter);
// m: the largest of 1, 2 or 5 times a power of ten that is not longer than `longest`.
double round_length(double longest);
// Lines that say what the drive does in a frame: f, Gamma and amplitude. While the drive grows or goes from
// one stage to another, these are the values of the moment.
std::vector<std::string> drive_lines(const FilmedScene& scene, const State& frame);
// Whether these lines differ from frame to frame.
bool drive_lines_change(const Drive& drive);
// As many lines as drive_lines() gives at most in the course of the film, each about as long as it gets.
std::vector<std::string> longest_drive_lines(const FilmedScene& scene);
// The place of a frame in the drive's period as it is shown: the phase in hundredths of a turn, never 1.00,
// and the cycle that this phase belongs to.
struct ShownCycle {
    long long cycle;
    double phase;
};
ShownCycle shown_cycle(const State& frame);
// The caption of time. While the grains still settle, it also says this. Empty where the film does not show
// it.
std::string playback_text(const Film& film, const State& frame, const std::string& playback);
// What has flowed out, the scene's own words (film.text, with the latest values of measures), and the caption
// shown at this time. longest_notes() gives texts about as long as these get: one for each caption, or a
// single one if there are no captions.
std::string note_text(const FilmedScene& scene, const Shot& frame);
std::vector<std::string> longest_notes(const FilmedScene& scene);
// How many lines of the gutter each line of a note may take.
inline int note_lines(const FilmedScene& scene) {
    return scene.film.captions.empty() ? 2 : 6;
}

}  // namespace grainreel
