// Forces on walls as measures count them: the quantum of their sums, pressure on standing faces, and the work
// of walls that move by themselves.
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

// A force's quantum is 2^-48 of what the stiffest wall would give the largest grain over its radius.
WallScale wall_scale(const Scene& scene, const Plan& plan);

// m2, of a face of the container ("left slant") between two heights (m); 0 for one that lies. Below the edge
// between slant and wall the width of front and back grows evenly with height.
double area_between(const Container& container, const std::string& face, double low, double high);

// Pressure on the faces of the container that stand, in slices of equal height.
class PressureProfile {
  public:
    explicit PressureProfile(const Scene& scene);

    const FieldSet& fields() const { return fields_; }
    // normal: N, of all slices, face after face.
    FieldValues pressures(const std::vector<double>& normal) const;

  private:
    FieldSet fields_;
    std::vector<std::size_t> faces_;         // which of the surroundings' faces each field is of
    std::vector<std::vector<double>> area_;  // m2, of each slice of those
};

// What walls that move by themselves give the grains: meshes that turn or move, and the faces of a container
// that turns.
//
// A rigid wall on which the grains have the force F and about a point P of it the moment M gives them the
// power -(F . v + M . w), v the velocity of P and w the wall's spin. Between two steps the impulses of F and
// M are those of every step (walls/wall_forces_observer.hpp). They are multiplied by the means of v and w, so
// the work is exact as long as these are steady. A wall whose velocity changes is looked at 128 times a
// period of the drive, or 64 times a row of measures.csv; the error then is of second order in that time.

// What the grains did to a wall between two moments, summed over the steps: N and N m. Times the step these
// are impulses.
struct WallSum {
    Vec3 force{0, 0, 0}, moment{0, 0, 0};
};
WallSum sum_between(const FaceSums& then, const FaceSums& now, const WallSums& sums);

class WallWork {
  public:
    WallWork(const Scene& scene, const Plan& plan);

    bool any() const { return any_; }  // walls that move by themselves
    // The first step after `step` at which gather() is wanted; Observer::kNever.
    std::int64_t gathers_after(std::int64_t step) const;
    void start(const ObservedState& m);
    void gather(const ObservedState& m);
    // J, given to the grains by each wall since start(), until this moment. Empty where none moves by itself.
    std::vector<double> until(const ObservedState& m) const;

    // Nothing is written where no wall moves by itself.
    void save(std::ostream& out) const;
    void load(const ObservedState& m, Bytes& in);

  private:
    std::vector<WallBody> walls_;
    std::vector<Body> bodies_;
    bool any_ = false;
    std::int64_t every_ = 0;  // steps; 0: no wall has a velocity that changes
    // At the last look.
    std::int64_t step_ = 0;
    std::vector<FaceSums> sums_;
    std::vector<BodyPose> poses_;  // of all bodies
    std::vector<double> turned_;   // rad, of those that turn
    std::vector<double> work_;     // J
};

}  // namespace grainreel
