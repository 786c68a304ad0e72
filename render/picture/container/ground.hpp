// The ground under the container, which shows nothing but a shadow, and fades towards the rim of the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/base/view.hpp"
#include "render/picture/container/shadow_map.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class Ground {
  public:
    // As wide and high as the port. Only for scenes with a container.
    Ground(const FilmedScene& scene, const Rectangle& port);

    void update(const Frame& frame, const View& view);

    // Darkens a row of the port, counted from the top. Threads may share the rows.
    void shade(int y, std::uint32_t* pixels) const;

  private:
    void darken();
    Vec3 on_ground(double u, double v) const;  // of the map's places from 0 to 1, in the lab
    Vec3 seen_at(double x, double y) const;
    bool is_seen() const;
    Rectangle where() const;

    static constexpr int kStride = ShadowMap::kSide + 2;

    ShadowMap map_;
    const float strength_;
    const int width_, height_;
    std::vector<float> rim_;     // by which the shadow fades towards the rim of the map
    std::vector<float> across_;  // by which it fades towards the picture's left and right
    std::vector<float> dark_;  // strength of the shadow, 0 to 255: the map's cells and a clear one all around
    Rectangle dark_cells_;     // of the map, outside of which all is clear
    View view_;
    Rectangle part_;  // pixels of the port, outside of which there is no shadow
};

}  // namespace grainreel
