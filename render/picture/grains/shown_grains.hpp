// Which grains of a frame are shown, and where a grain stands in a frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The points p that are kept: normal . p >= distance.
struct HalfSpace {
    Vec3 normal;
    double distance;  // m
};
// What the film's cut keeps of the bed: one half-space, or the two of a slab; empty without a cut. The cut
// goes with the floor, so it depends on the frame.
std::vector<HalfSpace> kept_by_cut(const FilmCut& cut, const Frame& frame);

class ShownGrains {
  public:
    // left_out: indices into scene.species. The grains of these species are treated as absent: they are not
    // lit, cast no shadow and are not counted in fields.
    ShownGrains(const FilmedScene& scene, const std::vector<std::size_t>& left_out);
    // Leaves out all grains but these; ids rise.
    static ShownGrains only(const FilmedScene& scene, std::vector<std::int32_t> ids);
    // Leaves out the grains that the film's cut takes away whole.
    static ShownGrains beside_cut(const FilmedScene& scene);

    // The frame itself when nothing is left out, otherwise a copy that the next call overwrites.
    const Frame& of(const Frame& frame);
    // Where a grain of the last of() was in the frame that was given.
    std::size_t place(std::size_t grain) const { return any() ? kept_[grain] : grain; }

  private:
    bool any() const { return !left_out_.empty() || !only_.empty() || cut_.present; }

    std::vector<bool> left_out_;      // for each species; empty: none is left out
    std::vector<std::int32_t> only_;  // ids; empty: all
    FilmCut cut_;                     // the cut that leaves grains out
    std::vector<std::size_t> kept_;
    Frame shown_;
};

}  // namespace grainreel
