// The words of a comparison: what its panels say of time, its warnings, and the values of --vary with their
// labels.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/film/compare/comparison.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What a panel says about time in each segment of the film. The comparison must have its members and
// pictures.
std::vector<std::string> playback_of(const ShotSource& source, const Comparison& all);

// What all panels say about time in one segment, as one line.
std::string playback_of_all(const std::vector<Panel>& panels, std::size_t segment);

// If a finished run chose the moments, warns of drives that seem to move at another frequency, because there
// are too few moments a period.
void warn_of_pace(Comparison& all);

// Warns of finished runs whose beds repeat themselves only every few periods of the drive, and of scenes that
// must show single moments beside a finished run although their films ask for means or exposures.
void warn_of_single_moments(Comparison& all);

// Warns of letters on the film that no font has.
void warn_of_missing_letters(Comparison& all);

// Warns of what a film of one scene would show and a comparison leaves out. The moments must be chosen
// already.
void warn_of_what_is_left_out(const PanelLayout& layout, Comparison& all);

// Several values of one key of a scene: `compare SCENE --vary drive.g_level=2,4`.

// Reads what was typed after --vary: the key with each of its values, as --set takes them. Values are split
// at commas outside of brackets and quotes. Throws UserError for fewer than two values, for an empty value or
// one that comes twice, and for a key of something that all panels share.
std::vector<Assignment> read_vary(const std::string& typed);

// The labels that tell the panels apart: "Γ = 2", "friction = 0.3", "density of big = 2500 kg/m3". scenes:
// the scenes as read with the values, in the same order.
std::vector<std::string> labels_of(const std::vector<Assignment>& values,
                                   const std::vector<FilmedScene>& scenes);

// Whether the value changes what happens in the scene, not only its picture or its random choices.
bool changes_the_scene(const Assignment& value);

// The name of a member's folder, "hopper-g_level-2".
std::string name_with(const std::string& name, const Assignment& value);

}  // namespace grainreel
