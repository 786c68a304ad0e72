// The words of the overlay: numbers with their units, as a reader wants them.
#pragma once

#include <string>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

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
// Where in the drive's period a frame is, as shown: the phase in hundredths of a turn, never 1.00, and the
// cycle that this phase belongs to.
struct ShownCycle {
    long long cycle;
    double phase;
};
ShownCycle shown_cycle(const Frame& frame);
// The caption of time, which says so while the grains still settle.
std::string playback_text(const Frame& frame, const std::string& playback);
// The scene's own words, film.text, with values of the last row of measures until the frame; and about as
// long as they get.
std::string note_text(const Scene& scene, const Frame& frame);
std::string longest_note(const Scene& scene);

}  // namespace grainreel
