// The mean velocity of the grains in the y-z plane, averaged over the whole depth, at the picture's moment or
// over the last period of the drive. It is momentum divided by mass, both coarse-grained as in fields.nc
// (engine/measure/fields).
#pragma once

#include <optional>

#include "engine/measure/fields/coarse_graining.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Describes the fields of a picture: in the y-z plane, with a kernel of this width (standard deviation, m)
// and cells as fine as `finest` (m), but not more cells than a picture has use for.
FieldOutput picture_fields(const FilmedScene& scene, double width, double finest);

// The values of a frame that are coarse-grained: places relative to the container, and velocities in the lab.
// period: velocities are the displacements over the last period, divided by it. Grains that were not there a
// period before are then left out. All grains are left out while the frame has no displacements.
FieldState field_state_of(const FilmedScene& scene, const Shot& frame, bool period);

class VelocityField {
  public:
    // width: m, the kernel's standard deviation.
    VelocityField(const FilmedScene& scene, double width, bool period);

    void take(const Shot& frame);
    // m/s, interpolated between the cells that have at least three grains under the kernel; none where the
    // other cells around the place have more than half of the weight. y, z: m, relative to the container.
    std::optional<Vec3> at(double y, double z) const;

  private:
    bool is_filled(std::size_t cell) const;

    const FilmedScene& scene_;
    const double width_;
    const bool period_;
    CoarseGraining sums_;
    CoarseFields fields_;
};

}  // namespace grainreel
