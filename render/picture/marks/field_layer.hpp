// A quantity of the grains as a coloured layer before them: its mean over the depth by coarse-graining,
// weighted by mass (engine/measure/fields). The layer stands in the container's front face.
#pragma once

#include <vector>

#include "engine/frame.hpp"
#include "engine/measure/fields/footprint.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/grain_colours.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FieldLayer {
  public:
    explicit FieldLayer(const FilmedScene& scene);

    // See Renderer.
    void start_from(const Frame& frame) { quantities_.start_from(frame); }
    void draw(const View& view, const Frame& frame, Shapes& on);
    const ClippedCount& clipped() const { return clipped_; }  // cells

  private:
    void gather(const Frame& frame);

    const FilmedScene& scene_;
    const FieldGrid grid_;
    const std::vector<double> shares_;  // of each cell that are inside the container
    Footprint footprint_;
    Quantities quantities_;
    ColourScale scale_;
    ClippedCount clipped_;
    std::vector<double> solid_, mass_, sum_;  // in each cell: solid fraction, kg/m3, and that times the mean
};

}  // namespace grainreel
