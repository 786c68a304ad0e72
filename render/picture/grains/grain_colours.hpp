// The quantity that colours the grains, grain by grain.
#pragma once

#include <array>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/colour_scale.hpp"
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

// The albedo of every grain: by species, or by a quantity through a colour map.

using Albedo = std::array<float, 3>;  // linear light
Albedo to_albedo(const Colour& colour);

// The colour of grains whose quantity is unknown, and of the legend's when colours say something else than
// the species.
inline constexpr Colour neutral_grain{0.62, 0.62, 0.62};  // sRGB

class GrainColours {
  public:
    explicit GrainColours(const FilmedScene& scene);

    // See Quantities.
    void start_from(const Frame& frame) { quantities_.start_from(frame); }

    // One a grain, in the frame's order.
    const std::vector<Albedo>& of(const Frame& frame);
    // How many of the grains that it has coloured by a quantity lay beyond the range.
    const ClippedCount& clipped() const { return clipped_; }

  private:
    Albedo of_value(double value) const;
    double share_of(double value) const;

    Quantities quantities_;
    bool by_species_;
    double low_ = 0, high_ = 1;  // SI
    bool banded_ = false, logarithmic_ = false;
    ClippedCount clipped_;
    std::vector<Albedo> steps_;  // a species each; or along the colour map, or its bands
    std::vector<Albedo> colours_;
};

}  // namespace grainreel
