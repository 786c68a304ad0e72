// One oblique impact of a sphere, for comparison with what experiments found.
#pragma once

#include "engine/plan/plan.hpp"

namespace grainreel {

struct ImpactLaw {
    NormalForce normal = NormalForce::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;
    double restitution = 1;
    double friction = 0;
    double stiffness_ratio = 0.8;  // tangential over normal
    Precision precision = Precision::full;
};

// After the impact, over the speed of approach. Along the plane and for equal spheres, the slip at the
// contact is tangential - spin.
struct Rebound {
    double normal;      // of the centres
    double tangential;  // of the centres
    double spin;        // radius times spin, of an equal sphere: of both together
};

// A sphere without spin meets a plane, or its equal, at an angle from the normal (degrees, below 90). The
// stiffness lets it in by 0.1 % of its radius at normal incidence; a contact takes 200 steps.
enum class Target { plane, equal_sphere };
Rebound rebound(const ImpactLaw& law, double degrees, Target target);

// The tangential ratio at which a sticking contact turns its slip by beta0:
// beta0 = -cos[sqrt(3.5 ratio) (pi/2) (1 + e)] (physics of two springs; Walton-Braun).
double ratio_that_turns(double restitution, double beta0);

}  // namespace grainreel
