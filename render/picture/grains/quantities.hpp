// The quantity that colours the grains, grain by grain.
#pragma once

#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class Quantities {
  public:
    Quantities(const FilmedScene& scene, GrainValue by);

    // Start heights are counted from this frame; without a call, from the first one that of() sees.
    void start_from(const Frame& frame);

    // SI, one a grain in the frame's order; NaN for a grain that has no value: it was not there at the start,
    // or the frame lacks what the quantity needs (displacements before a period has passed). All NaN when
    // coloured by species.
    const std::vector<double>& of(const Frame& frame);

  private:
    double start_height_of(std::int32_t id) const;  // NaN when it was not there
    void count_touches(const Frame& frame, bool forces);

    const GrainValue by_;
    std::vector<double> density_;         // kg/m3, by species
    std::vector<std::int32_t> start_id_;  // rising; ids may be far apart
    std::vector<double> start_height_;    // m, theirs
    std::vector<double> values_;
};

}  // namespace grainreel
