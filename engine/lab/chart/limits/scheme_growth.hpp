// How a disturbance grows in one step of an integrator, for a harmonic oscillator: linear stability theory.
#pragma once

#include "engine/scene/scene.hpp"

namespace grainreel {

// Spectral radius of one step's amplification matrix at this step x angular frequency.
double growth_a_step(Integrator integrator, double step);

// Largest step x angular frequency up to which nothing grows.
double stability_limit(Integrator integrator);

}  // namespace grainreel
