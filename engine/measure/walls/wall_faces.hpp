// Forces on walls for measures: the quantum of their sums, pressure on upright faces, and the work of walls
// that move by themselves.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/step/geometry/wall_sums.hpp"

namespace grainreel {

// The quantum of a force. It is 2^-48 of the force of the stiffest wall on the largest grain when they
// overlap by the grain's radius, rounded down to a power of two.
WallScale wall_scale(const Scene& scene, const Plan& plan);

// Area (m2) of a face of the container ("left slant") between two heights (m); 0 for a level face. Below the
// edge between slant and wall the width of front and back grows evenly with height.
double area_between(const Container& container, const std::string& face, double low, double high);

// Pressure on the upright faces of the container, in slices of equal height.
class PressureProfile {
  public:
    explicit PressureProfile(const Scene& scene);

    const FieldSet& fields() const { return fields_; }
    // `normal` holds the normal forces (N) on all slices, face after face.
    FieldValues pressures(const std::vector<double>& normal) const;

  private:
    FieldSet fields_;
    std::vector<std::size_t> faces_;         // for each field, the number of its face in the surroundings
    std::vector<std::vector<double>> area_;  // m2, of each slice of these faces
};

// The work that walls do on the grains when they move by themselves: meshes that turn or move, and the faces
// of a container that turns.
//
// A rigid wall on which the grains exert the force F, and the moment M about a point P of the wall, gives
// them the power -(F . v + M . w), where v is the velocity of P and w is the wall's spin. The impulses of F
// and M between two looks are summed over every step (walls/wall_forces_observer.hpp). They are multiplied by
// the means of v and w, so the work is exact as long as v and w are steady. A wall whose velocity changes is
// looked at 128 times per period of the drive, or 64 times per row of measures.csv. Its work then has an
// error of second order in the time between two looks.

// Force (N) and moment (N m) of the grains on a wall between two moments, summed over the steps. Multiplied
// by the step, they are impulses.
struct WallSum {
    Vec3 force{0, 0, 0}, moment{0, 0, 0};
};
WallSum sum_between(const FaceSums& then, const FaceSums& now, const WallSums& sums);

class WallWork {
  public:
    WallWork(const Scene& scene, const Plan& plan);

    bool any() const { return any_; }  // whether any wall moves by itself
    // The first step after `step` at which gather() is to be called, or Observer::kNever.
    std::int64_t gathers_after(std::int64_t step) const;
    void start(const ObservedState& m);
    void gather(const ObservedState& m);
    // Energy (J) that each wall has given to the grains from start() until this moment. Empty if no wall
    // moves by itself.
    std::vector<double> until(const ObservedState& m) const;

    // Nothing is written if no wall moves by itself.
    void save(std::ostream& out) const;
    void load(const ObservedState& m, Bytes& in);

  private:
    std::vector<WallBody> walls_;
    std::vector<Body> bodies_;
    bool any_ = false;
    std::int64_t every_ = 0;  // steps between two looks; 0 if no wall has a velocity that changes
    // State at the last look.
    std::int64_t step_ = 0;
    std::vector<FaceSums> sums_;
    std::vector<BodyPose> poses_;  // poses of all bodies
    std::vector<double> turned_;   // rad, angles of the bodies that turn
    std::vector<double> work_;     // J
};

}  // namespace grainreel
