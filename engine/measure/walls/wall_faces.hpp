// The faces of a scene as measures see them: what their sums are counted in, and pressure on them.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
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

}  // namespace grainreel
