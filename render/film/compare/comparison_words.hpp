// What the panels of a comparison say of time, and what is said of them beforehand.
#pragma once

#include <string>
#include <vector>

#include "render/film/compare/comparison.hpp"

namespace grainreel {

// What a panel says of time in each segment of the film. The comparison has its members and pictures.
std::vector<std::string> playback_of(const FrameSource& source, const Comparison& all);

// What all panels say of it in one segment, in one line.
std::string playback_of_all(const std::vector<Panel>& panels, std::size_t segment);

// Drives that would seem to move at another frequency, in panels that show moments of a finished run.
void warn_of_pace(Comparison& all);

// Periods of their beds by which finished runs go, and means and exposures that are not to be had beside
// them.
void warn_of_single_moments(Comparison& all);

// Letters of words on the film that no font has.
void warn_of_missing_letters(Comparison& all);

// What a film of one scene would show and this one does not. The film of the whole has its moments.
void warn_of_what_is_left_out(const PanelLayout& layout, Comparison& all);

}  // namespace grainreel
