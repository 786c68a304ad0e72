// The ground under the container, which shows nothing but the shadow of container and grains, and the map of
// that shadow.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/state/state.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A map of the ground, in the lab: the share of the key light that does not arrive, 0 to 1. Shadows are soft,
// since the lamp is wide.
class ShadowMap {
  public:
    static constexpr int kSide = 192;  // cells

    // The ground lies under the lowest point that the container reaches. The scene must have a container, and
    // its grains must not fall through the ground: it has no outlet without a tray, and no box that grains
    // leave through.
    explicit ShadowMap(const FilmedScene& scene);

    // to_key: unit vector towards the key light, in the lab.
    void cast(const State& frame, const Vec3& to_key);

    const std::vector<float>& cells() const { return cells_; }  // rows along y, x fastest
    double height() const { return height_; }                   // m, z of the ground
    Eigen::Vector2d low() const { return low_; }                // m, the map's corner
    double side() const { return side_; }                       // m

  private:
    void place(const Vec3& to_key);
    void place_around_extent(const Vec3& to_key);
    void add_plate(const State& frame, const Vec3& to_key);
    void add_grains(const State& frame, const Vec3& to_key);
    void add_meshes(const State& frame, const Vec3& to_key);
    void add_depth(const Eigen::Vector2d& at, double depth);
    void soften();
    // Where light that passes `point` meets the ground, in cells.
    Eigen::Vector2d fall(const Vec3& point, const Vec3& to_key) const;

    const Container container_;
    const MeshShadows meshes_;
    const Extent extent_;
    const Container foot_;  // what stands on the ground: the container, or the tray below it
    double height_ = 0, low_plate_ = 0, aside_ = 0;  // m; aside_: horizontal stroke, as it is drawn
    Eigen::Vector2d low_{0, 0};
    double side_ = 1;
    std::vector<float> cells_, before_;
};

// The shadow on the ground as the camera sees it. It fades towards the rim of the picture.
class Ground {
  public:
    // The scene must have a container.
    Ground(const FilmedScene& scene, const Rectangle& port);

    void update(const State& frame, const View& view);

    // Darkens row y of the port, counted from the top. Several threads may work on different rows.
    void shade(int y, std::uint32_t* pixels) const;

  private:
    void darken();
    Vec3 on_ground(double u, double v) const;  // m, in the lab; u and v: place on the map, 0 to 1
    Vec3 seen_at(double x, double y) const;
    bool is_seen() const;
    Rectangle where() const;

    static constexpr int kStride = ShadowMap::kSide + 2;

    ShadowMap map_;
    const float strength_;
    const int width_, height_;
    std::vector<float> rim_;     // shares by which the shadow fades towards the rim of the map
    std::vector<float> across_;  // shares by which it fades towards the picture's left and right
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
