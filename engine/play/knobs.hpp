// Knobs: the few values of a scene that a page lets its reader change, each under the key of the scene file
// that it stands for, with its range; the rules by which some act on a moving bed and others pack it anew.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

struct Knob {
    std::string key;  // "drive.frequency", "species.nut.count"
    Dimension dimension = Dimension::number;
    double low = 0, high = 0;  // SI
    bool whole = false;        // takes whole numbers only
    bool packs_anew = false;   // acts on a new bed only
    std::string label = {};    // the scene's own words; empty: the usual ones
};

// Every knob that this scene can have, with the widest sensible range around its present value.
std::vector<Knob> possible_knobs(const Scene& scene);

// The knobs of a page: those that the scene names, with its ranges and labels, or else a handful of the
// possible ones. Throws UserError where it names one that it cannot have.
std::vector<Knob> knobs_of(const Scene& scene);

// The value of a knob in the scene, in SI. The scene must be one that has this knob.
double knob_value(const Scene& scene, std::string_view key);

// The scene with another value. Stages of its drive are left as they are: those of a moving bed are added by
// PlayedBed. Throws UserError for a key that is no knob of this scene.
void turn_knob(Scene& scene, std::string_view key, double value);

}  // namespace grainreel
