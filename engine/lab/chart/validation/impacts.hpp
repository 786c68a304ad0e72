// One oblique impact of a sphere, for comparison with experiments.
#pragma once

#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

struct ImpactLaw {
    NormalForce normal = NormalForce::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;
    double restitution = 1;
    double friction = 0;
    double stiffness_ratio = 0.8;  // tangential divided by normal stiffness
    Precision precision = Precision::full;
};

// Velocities after the impact, divided by the speed of approach. For the plane and for equal spheres, the
// slip at the contact is tangential - spin.
struct Rebound {
    double normal;      // speed of the centres
    double tangential;  // speed of the centres
    double spin;        // radius times spin; for two equal spheres the sum of both
};

// A sphere without spin meets a plane, or an equal sphere, at an angle from the normal (degrees, below 90).
// The stiffness gives an overlap of 0.1 % of the radius at normal incidence; a contact takes 200 steps.
enum class Target { plane, equal_sphere };
Rebound rebound(const ImpactLaw& law, double degrees, Target target);

// The stiffness ratio at which a sticking contact reverses its slip and multiplies it by beta0: beta0 =
// -cos[sqrt(3.5 ratio) (pi/2) (1 + e)] (from the motion of two springs; Walton-Braun).
double ratio_that_turns(double restitution, double beta0);

}  // namespace grainreel

// Measurements of Kharaz, Gorham & Salman (2001, Powder Technol. 120, 281): 5 mm alumina spheres shot at
// thick glass at 3.85 m/s without spin, with restitution 0.98 and friction 0.092 at all angles.
//
// Others have read the points off the figures, to about a hundredth of the full scale: restitution and spin
// in the benchmarks of Kratos (after Chung & Ooi 2011, Granul. Matter 13, 643), the angle of rebound in the
// examples of Lethe.

namespace grainreel::kharaz {

constexpr double restitution = 0.98, friction = 0.092;
constexpr double radius = 0.0025, density = 3900, speed = 3.85;  // m, kg/m3, m/s

struct Point {
    double degrees;  // angle of incidence from the normal
    double value;
};
// Tangential velocity of the centre after the impact divided by that before.
inline const std::vector<Point> tangential_restitution = {
    {2.24, 0.797},  {4.22, 0.746},  {9.84, 0.675},  {20.22, 0.599}, {30.36, 0.690},
    {39.54, 0.774}, {49.60, 0.848}, {71.07, 0.937}, {79.23, 0.970}, {85.17, 0.979}};
// Spin after the impact, rad/s.
inline const std::vector<Point> spin = {{5.90, 135},  {10.87, 261}, {21.12, 574}, {31.14, 612}, {38.95, 595},
                                        {50.24, 450}, {60.10, 376}, {69.96, 243}, {78.56, 142}, {84.32, 71}};
// Angle of the centre's path after the impact from the normal, in degrees.
inline const std::vector<Point> rebound = {{2.15, 1.73},   {4.10, 2.96},   {9.83, 6.52},   {20.57, 12.21},
                                           {30.29, 21.67}, {39.54, 32.61}, {49.75, 45.13}, {60.21, 57.47}};

}  // namespace grainreel::kharaz
