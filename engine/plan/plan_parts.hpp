// The parts of the plan: what the bed is like, the contacts' numbers, the step. make_plan() puts them
// together; code that hands a scene over to another engine plans contacts one by one.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/plan/plan_bed.hpp"

namespace grainreel {

// What the whole bed is like, and how hard it is shaken.
struct BedPlan {
    double gravity = 0;          // m/s2
    double g_level = 0;          // Gamma; 0 without a drive or without gravity
    double frequency = 0;        // Hz; 0 without a drive
    double height = 0;           // m, at a solid fraction of 0.6
    double layers = 1;           // number of layers of grains of mean diameter
    double largest_density = 0;  // kg/m3
    double largest_mass = 0;     // kg, of one grain
    double usual_mass = 0;       // kg, of a grain of mean size, the mean over contacts
    double carried_height = 0;   // m, min(height, twice the width): what presses on the floor (Janssen)
    double drop_speed = 0;       // m/s, of the highest fall while settling; 0 when nothing settles
    double impact_speed = 0;     // m/s, v*
    double speed_of_others = 0;  // m/s, v* if no wall had a motion of its own
};
BedPlan plan_bed(const Scene& scene, const StartFacts& file);

double mass_of(const Species& species, double diameter);  // kg
// The restitution at a speed (m/s), interpolated linearly between the rows of the table and constant beyond
// its ends.
double restitution_at(const std::vector<RestitutionPoint>& table, double speed);

// Two grains that may touch, or a grain and a wall (whose mass is infinite). Sizes in m, masses in kg.
struct PairSizes {
    double diameter;  // diameter of the smaller one
    double distance;  // between centres, or to the wall
    double effective_mass;
    double effective_radius;
};
std::vector<PairSizes> extremes(const Species& a, const Species* b);  // smallest, mean and largest grains of
                                                                      // both, the smallest first; b: nullptr
                                                                      // for a wall
PairSizes mean_touching(const Species& a, const Species* b);          // both of mean size
double mean_effective_mass(const Species& a, const Species* b);

// Plans stiffness, damping and times of one kind of contact.
PairPlan plan_pair(const Scene& scene, const BedPlan& bed, const PairContact& contact, const Species& a,
                   const Species* b);

// The largest overlap, divided by the smaller diameter, that impacts and weight are expected to cause.
// `landing` (kg) is the mass of the grain that lands: stiffness is chosen for the impact of the pair alone,
// but a heavy grain that lands on three others drives these deeper into each other and into the wall. (In
// scenes/wedge_mixing.toml this expects 3.2 %, and 3.3 % were seen within 3 s.)
double expected_overlap(const Scene& scene, const BedPlan& bed, const PairPlan& pair,
                        const std::vector<PairSizes>& sizes, double landing);

// Whether impacts of this restitution lose so little that the gain of the contact corrections would count. In
// an elastic impact the corrections gain (w dt)^4 / 20 of its energy, w^2 = K1 / m_eff, with w dt = pi / 12
// at 12 steps per contact (the onset in walton_braun_corrected-inl.hpp adds (w s)^4 / 4 if the grains touch a
// time s before the force, s from 0 to dt). They are used where an impact loses twenty times that: 1 - e^2 >=
// (pi / 12)^4, e < 0.9976.
bool nearly_elastic(double restitution);

// Number of steps in a free impact. At standard accuracy velocity Verlet then keeps the restitution of Walton
// and Braun's law within 0.005: without contact corrections when the number is whole, with them at any
// number. That of a spring-dashpot is up to 0.016 off (plan_step.cpp). Nearly elastic grains keep their
// energy as well as those of a spring-dashpot do.
int steps_per_contact(NormalForce law, double restitution, Accuracy accuracy = Accuracy::standard);

// The longest stable step times the fastest angular frequency: 2 for Verlet in all its forms, sqrt 2 for
// Gear's four values; for Omelyan's scheme it follows from the amplification matrix.
double stable_step(Integrator integrator);

struct StepChoice {
    double step = 0;    // s
    double stable = 0;  // s, above which the integrator diverges
    std::string reason;
};
StepChoice plan_step(const Scene& scene, const Plan& plan);

// Warnings of values that are hardly meant, such as a density of 7.8 kg/m3.
std::vector<std::string> likely_slips(const Scene& scene);

// Warns of grains that would lie in an exit when the drive starts. Where grains are packed, their number is
// estimated from the room that the bed takes up.
std::vector<std::string> exit_warnings(const Scene& scene);
// Warns of contacts: too soft, too long, too stiff, or too few steps in one.
class Warnings;
void warn_of_contacts(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings);
void warn_of_few_steps(const Scene& scene, const Plan& plan, Warnings& warnings);
// Warnings of what will run, but perhaps not as intended.
std::vector<std::string> plan_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed,
                                       const StepChoice& step);
// Warnings of what follows from the start file.
std::vector<std::string> start_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed);

}  // namespace grainreel
