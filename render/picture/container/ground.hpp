// The ground that a container stands on: its colour, which goes over into the backdrop behind, and the shadow
// and the darkness at the foot that it shows.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/state/state.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/container/shadow_map.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The ground as the camera sees it, bent up behind the container to a backdrop, as paper is in a studio. Both
// are a little of the walls' colour on the background's, the same along each row of the whole picture, also
// below the words.
class Ground {
  public:
    // The scene must have a container or meshes.
    Ground(const FilmedScene& scene, const Palette& palette, const Rectangle& port);

    // Finds the rows of ground and backdrop. Call it first, and again when the camera has moved.
    void stand(const View& view);
    // Tints a part of the picture that has words on the plain background.
    void tint(const Rectangle& part, Picture& picture) const;

    void update(const State& frame, const View& view);

    // Paints row y of the port, counted from the top. Several threads may work on different rows.
    void paint(int y, std::uint32_t* pixels) const;

  private:
    void darken();
    Vec3 on_ground(double u, double v) const;  // m, in the lab; u and v: place on the map, 0 to 1
    Vec3 seen_at(double x, double y) const;
    Rectangle where() const;
    double rise(double y) const;
    double bend() const;
    void shade(int y, std::uint32_t* pixels) const;

    static constexpr int kStride = ShadowMap::kSide + 2;

    ShadowMap map_;
    const Colour background_, tint_;
    const Vec3 middle_;
    const double size_;  // m, of what the camera looks at
    const Rectangle port_;
    const int width_, height_;   // of the port
    std::vector<float> rim_;     // shares by which the shadow fades towards the rim of the map
    std::vector<float> across_;  // shares by which it fades towards the port's left and right
    std::vector<double> tone_;   // for each row of the picture: share of the tint
    std::vector<float> dark_;  // strength of the shadow, 0 to 255: the map's cells and a clear one all around
    Rectangle dark_cells_;     // cells of the map; all cells outside are clear
    View view_;
    Rectangle part_;  // pixels of the port; there is no shadow outside
};

// A map of how much each place is darkened.
struct ShadeMap {
    const float* cells;  // strengths of 0 to 255, rows of `side` numbers; those on the rim are 0
    int side;
};

// (u, v, w) of the first pixel, and its step from each pixel to the next. u/w, v/w is the place on the map,
// in cells from the middle of the first one. Places beside the map are not darkened.
struct MapWalk {
    Eigen::Vector3f first, step;
};

// Darkens a row of pixels by the map's strengths at the places that they show (shade_row.cpp, compiled for
// each instruction set): pixels[i] = over(black of strength map * across[i] * all, pixels[i]). Between cells
// strengths are interpolated along both axes.
void shade_row(const ShadeMap& map, const MapWalk& walk, const float* across, float all,
               std::uint32_t* pixels, int count);

}  // namespace grainreel
