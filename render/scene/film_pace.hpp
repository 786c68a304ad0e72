// The segments of a film, and how fast it plays in words: pacing itself is in film/sampling. The layout of a
// picture asks for these words, so that they have the room that they need.
#pragma once

#include <string>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The segments of a film; one with the defaults if the scene has none.
std::vector<FilmSegment> segments_of(const Film& film);

// What a frame's caption says about time: "real time", "slow motion, 1/10 speed" or "1 frame a period at
// phase 0.25 (plays 1.5×)". UTF-8.
std::string playback_caption(const FilmSegment& segment, const Drive& drive, double film_rate,
                             const Wording& say = {});

// The segment as it is shown while the bed repeats itself after `periods` periods of the drive. A whole
// multiple of `periods` lies between its locked frames, and its means span a whole multiple.
FilmSegment spanning(FilmSegment segment, int periods);

// A playback as "1/10", "1/2.5" or "0.35": the form that is easiest to read.
std::string speed_words(double playback);

// All captions of time that the film may have: those of its segments, while the bed repeats itself after one
// or two periods.
std::vector<std::string> playback_captions(const Film& film, const Drive& drive);

// "2.5 s", "25 ms", "400 µs": at most three digits, in the unit that suits the time.
std::string time_span_text(double seconds);

}  // namespace grainreel
