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
// What shakes in one line: "15 Hz, Γ = 4", "taps of 20 Hz, Γ = 4", "at rest". A part that is not wanted is
// left out.
struct ShakingParts {
    bool frequency = true, g_level = true;
};
std::string shaking_text(const FilmedScene& scene, const State& frame, ShakingParts parts = {});
std::string longest_shaking_text(const FilmedScene& scene, ShakingParts parts = {});
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
// What has flowed out, and the scene's own words (film.text, with the latest values of measures).
// longest_note() gives a text about as long as these get.
std::string note_text(const FilmedScene& scene, const Shot& frame);
std::string longest_note(const FilmedScene& scene);
// The caption that is shown at the frame's time; empty for none.
// A caption that lasts until the run ends (at `end`, s) stands on the last picture too, at which players
// stop.
std::string caption_at(const Film& film, double end, const Shot& frame);
// The caption, with values about as long as they get.
std::string longest_caption(const FilmCaption& caption);
// A note with a caption below it.
std::string joined(const std::string& note, const std::string& caption);
constexpr int note_lines = 3;  // lines of the gutter that each line of a note may take

}  // namespace grainreel
