// The grains as a picture shows them: which grains of a frame are shown, where they stand in the frame, and
// in which colours. A new quantity for colours is a GrainValue (render/scene/film.hpp) with a case in
// Quantities::of().
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The points p that are kept: normal . p >= distance.
struct HalfSpace {
    Vec3 normal;
    double distance;  // m
};
// What the film's cut keeps of the bed: one half-space, or the two of a slab; empty without a cut. The cut
// goes with the floor, so it depends on the frame.
std::vector<HalfSpace> kept_by_cut(const FilmCut& cut, const State& frame);

// Leaves out the grains that a picture does not show.
class ShownGrains {
  public:
    // left_out: indices into scene.species. The grains of these species are treated as absent: they are not
    // lit, cast no shadow and are not counted in fields.
    ShownGrains(const FilmedScene& scene, const std::vector<std::size_t>& left_out);
    // Leaves out all grains but these; ids rise. An empty list leaves out none.
    static ShownGrains only(const FilmedScene& scene, std::vector<std::int32_t> ids);
    // Leaves out the grains that the film's cut takes away whole.
    static ShownGrains beside_cut(const FilmedScene& scene);

    // The frame itself when nothing is left out, otherwise a copy that the next call overwrites.
    const Shot& of(const Shot& frame);
    const Shot& of(Shot&&) = delete;  // it would not outlive the call
    // The index that a grain of the last of() has in the frame that was given to it.
    std::size_t place(std::size_t grain) const { return any() ? kept_[grain] : grain; }

  private:
    bool any() const { return !left_out_.empty() || !only_.empty() || cut_.present; }

    std::vector<bool> left_out_;      // for each species; empty: none is left out
    std::vector<std::int32_t> only_;  // ids; empty: all
    FilmCut cut_;                     // the cut that leaves grains out
    std::vector<std::size_t> kept_;
    Shot shown_;
};

// The quantity of each grain that its colour stands for.
class Quantities {
  public:
    Quantities(const FilmedScene& scene, GrainValue by);

    // Takes the heights at the start from this frame. Without a call they come from the first frame that of()
    // sees.
    void start_from(const State& frame);

    // SI: the value of each grain, in the frame's order. It is NaN where it is not known: the start height of
    // a grain that was not there at the start, and displacements before a period has passed. It is NaN for
    // all grains if they are coloured by species.
    const std::vector<double>& of(const Shot& frame);

  private:
    double start_height_of(std::int32_t id) const;  // m; NaN when the grain was not there
    void count_touches(const Shot& frame, bool forces);

    const GrainValue by_;
    std::vector<double> density_;         // kg/m3, by species
    std::vector<std::int32_t> start_id_;  // rising; ids may be far apart
    std::vector<double> start_height_;    // m: heights of the grains of start_id_
    std::vector<double> values_;
};

using Albedo = std::array<float, 3>;  // linear light
Albedo to_albedo(const Colour& colour);

// The colour of grains whose quantity is unknown, and of the legend's grains where colours do not stand for
// species.
inline constexpr Colour neutral_grain{0.62, 0.62, 0.62};  // sRGB

// The albedo of every grain: by species, or by a quantity through a colour map, for all species or for some.
class GrainColours {
  public:
    explicit GrainColours(const FilmedScene& scene);

    // See Quantities::start_from().
    void start_from(const State& frame) { quantities_.start_from(frame); }

    // The albedo of each grain, in the frame's order.
    const std::vector<Albedo>& of(const Shot& frame);
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
    std::vector<std::optional<Albedo>> own_;  // by species: its own colour, if no quantity colours it
    std::vector<Albedo> steps_;  // one for each species, each band or each step of the colour map
    std::vector<Albedo> colours_;
};

}  // namespace grainreel
