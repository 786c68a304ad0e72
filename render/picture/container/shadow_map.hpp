// The shadow that container and grains throw on a ground under them.
#pragma once

#include <array>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/bed.hpp"
#include "render/picture/container/mesh_shadows.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A map of the ground, in the lab: how much of the key light is taken, 0 to 1. Soft, since the lamp is wide.
class ShadowMap {
  public:
    static constexpr int kSide = 192;  // cells

    // The ground lies under the lowest point that the container reaches. Only for scenes with a container
    // that grains do not leave below.
    explicit ShadowMap(const FilmedScene& scene);

    // to_key: unit, in the lab.
    void cast(const Frame& frame, const Vec3& to_key);

    const std::vector<float>& cells() const { return cells_; }  // rows along y, x fastest
    double height() const { return height_; }                   // m, z of the ground
    Eigen::Vector2d low() const { return low_; }                // m, the map's corner
    double side() const { return side_; }                       // m

  private:
    void place(const Vec3& to_key);
    void place_around_extent(const Vec3& to_key);
    void add_plate(const Frame& frame, const Vec3& to_key);
    void add_grains(const Frame& frame, const Vec3& to_key);
    void add_meshes(const Frame& frame, const Vec3& to_key);
    void add_depth(const Eigen::Vector2d& at, double depth);
    void soften();
    // Where the light that passes `point` meets the ground, in cells.
    Eigen::Vector2d fall(const Vec3& point, const Vec3& to_key) const;

    const Container container_;
    const MeshShadows meshes_;
    const Extent extent_;
    const Container foot_;  // what stands on the ground: the container, or the tray below it
    double height_ = 0, low_plate_ = 0;
    Eigen::Vector2d low_{0, 0};
    double side_ = 1;
    std::vector<float> cells_, before_;
};

}  // namespace grainreel
