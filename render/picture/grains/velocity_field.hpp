// The grains' mean velocity in the y-z plane, all along the depth: momentum over mass by coarse-graining, as
// fields.nc has it (engine/measure/fields), of the picture's moment or of the last period of the drive.
#pragma once

#include <functional>
#include <optional>

#include "engine/frame.hpp"
#include "engine/measure/fields/coarse_graining.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Fields of a picture: in the y-z plane, with a kernel of this width (standard deviation, m) and cells as
// fine as `finest` (m), but not more cells than a picture has use for.
FieldOutput picture_fields(const FilmedScene& scene, double width, double finest);

// What coarse-graining takes of a frame: places from where the container is, velocities of the room. period:
// displacements over a period in place of velocities; grains that were not there a period before are left
// out, and all are while the frame has no displacements.
FieldState field_state_of(const FilmedScene& scene, const Frame& frame, bool period);

class VelocityField {
  public:
    // width: m, the kernel's standard deviation.
    VelocityField(const FilmedScene& scene, double width, bool period);

    void take(const Frame& frame);
    // m/s, between cells by straight lines; none where fewer than three grains lie under the kernel. y, z: m,
    // from the container.
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
