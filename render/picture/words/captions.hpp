// The words of the overlay: numbers with their units, as a reader wants them.
#pragma once

#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// That the frame has; empty for none.
std::string shown_title(const Film& film);
// "5 mm", "1.25 cm", "320 µm": three digits at most, the unit that suits the size.
std::string length_text(double metres);
// "20 Hz", "1.5 kHz".
std::string frequency_text(double hertz);
// "t = 3.250 s"
std::string time_text(double seconds, double duration);  // in ms where all lasts less than 0.1 s
// "5 mm" or, for a spread, "4–6 mm"
std::string diameter_text(const SizeSpread& diameter);
// The longest 1, 2 or 5 times a power of ten that is not longer; m.
double round_length(double longest);
// What the drive does in a frame, a line each: f, Gamma and amplitude, of the stage that is on where it has
// stages. In a change, and while the drive grows at first, they are those of the moment.
std::vector<std::string> drive_lines(const FilmedScene& scene, const Frame& frame);
// Whether they differ from frame to frame.
bool drive_lines_change(const Drive& drive);
// About as long as any of them get in the course of the film, and as many.
std::vector<std::string> longest_drive_lines(const FilmedScene& scene);
// Where in the drive's period a frame is, as shown: the phase in hundredths of a turn, never 1.00, and the
// cycle that this phase belongs to.
struct ShownCycle {
    long long cycle;
    double phase;
};
ShownCycle shown_cycle(const Frame& frame);
// The caption of time, which says so while the grains still settle. Empty where the film does not show it.
std::string playback_text(const Film& film, const Frame& frame, const std::string& playback);
// What has flowed out, the scene's own words (film.text, with values of the last row of measures until the
// frame), and the caption of this time. And about as long as they get: with each caption, or the one without
// any.
std::string note_text(const FilmedScene& scene, const Frame& frame);
std::vector<std::string> longest_notes(const FilmedScene& scene);
// Into how many lines of the gutter each of their lines may break.
inline int note_lines(const FilmedScene& scene) {
    return scene.film.captions.empty() ? 2 : 6;
}

}  // namespace grainreel
