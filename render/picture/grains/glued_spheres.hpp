// The grains that are glued to walls, as they are drawn: in the colour of their species, greyer.
#pragma once

#include <array>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/grain_colours.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class GluedSpheres {
  public:
    explicit GluedSpheres(const FilmedScene& scene);

    struct Seen {
        Vec3 centre;    // m, where it is now
        double radius;  // m
    };
    // Those at front, back, floor, lid and round walls only where the eye looks at the inner side: otherwise
    // they would hide the bed.
    std::vector<Seen> seen(const View& view, const Frame& frame) const;
    const Albedo& colour() const { return colour_; }

  private:
    struct Glued {
        Vec3 at_rest, inward;  // m; unit, into the container
        double radius;         // m
        std::size_t body;
        bool at_side;  // seen from everywhere
    };
    std::vector<Glued> glued_;
    Albedo colour_{};
};

}  // namespace grainreel
