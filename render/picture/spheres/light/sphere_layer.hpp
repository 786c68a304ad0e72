// Lit grains on nothing: who is seen (Visibility), what walls hide of them (WallOrder), who takes light from
// whom (Neighbourhood), then each pixel lit once, and those on edges once for each grain that shares them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/band_painter.hpp"
#include "render/picture/spheres/light/neighbourhood.hpp"
#include "render/picture/spheres/visibility.hpp"
#include "render/picture/spheres/wall_order.hpp"

namespace grainreel {

// What is drawn. One entry a grain; `poles` and `painted` may be empty.
struct Spheres {
    std::vector<ViewSphere> spheres;
    std::vector<std::array<float, 3>> albedo;  // linear
    std::vector<std::array<float, 3>> poles;   // unit: axes of two-tone grains, in view coordinates
    std::vector<std::uint8_t> painted;         // 0: hides others and takes their light, but leaves no colour
};

class SphereLayer {
  public:
    SphereLayer(int width, int height) : visibility_(width, height), layer_(width, height) {}

    // One after the other. The team's size does not show in the picture.
    void find_visible(const Sight& sight, const Cut& cut, const Spheres& spheres, Team& team,
                      const SolidDepth& solid = {});
    // Faces in view coordinates.
    void find_order(const Sight& sight, const Cut& cut, const Spheres& spheres,
                    const std::vector<WallFace>& faces, Team& team);
    void find_neighbours(const Cut& cut, const Lamp& lamp, const Spheres& spheres, Team& team);
    const Layer& light(const Sight& sight, const Cut& cut, const Lamp& lamp, const Spheres& spheres,
                       Team& team);

    const Visibility& visibility() const { return visibility_; }
    const Neighbourhood& neighbourhood() const { return neighbourhood_; }
    const WallOrder& wall_order() const { return wall_order_; }

  private:
    Visibility visibility_;
    WallOrder wall_order_;
    Neighbourhood neighbourhood_;
    Layer layer_;
    std::vector<std::uint32_t> slot_of_;  // a grain: its place among those shown
    std::vector<BandPainter> painters_;   // a thread
};

}  // namespace grainreel
