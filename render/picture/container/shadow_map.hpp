// A map of the ground under a container: how much light from the lamp and from all around does not arrive.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/state/state.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The ground is level for the camera: its normal is film.camera.up. Places on it are counted along two level
// axes, and heights along the normal, all from the lab's origin.
class ShadowMap {
  public:
    static constexpr int kSide = 192;  // cells

    // The ground lies under the lowest point that the container reaches, and under the place where grains
    // leave. The scene must have a container.
    explicit ShadowMap(const FilmedScene& scene);

    // to_key: unit vector towards the key light, in the lab.
    void cast(const State& frame, const Vec3& to_key);

    const std::vector<float>& cells() const { return cells_; }    // share of the key light, 0 to 1; x fastest
    const std::vector<float>& closed() const { return closed_; }  // share of the light from all around
    double height() const { return height_; }                     // m, of the ground
    Eigen::Vector2d low() const { return low_; }                  // m, the map's corner
    double side() const { return side_; }                         // m
    // m: the place in the lab of a point on level axes.
    Vec3 in_lab(const Vec3& level) const { return level_.transpose() * level; }
    Vec3 on_level(const Vec3& lab) const { return level_ * lab; }

  private:
    // A piece of a wall that takes light.
    struct Patch {
        Vec3 at, area;  // m, at rest; m2, along its normal, times the share of the light that it takes
    };

    double lowest(const FilmedScene& scene) const;
    void add_walls();
    void place(const Vec3& to_key);
    void add_plate(const State& frame, const Vec3& to_key);
    void add_foot(const State& frame);
    void add_bodies(const State& frame, const Vec3& to_key);
    void add_depth(std::vector<float>& map, const Eigen::Vector2d& at, double depth) const;
    // Calls visit(cell, point, up): where the way up from a cell of the ground is in the frame of the plate.
    template <class Visit>
    void from_cells(const State& frame, const Vec3& to_light, const Visit& visit);
    BodyPose pose_of_foot(const State& frame) const;
    double beside_foot(const Vec3& at, double room) const;
    void soften(std::vector<float>& map);
    // Where light that passes `point` meets the ground, in cells.
    Eigen::Vector2d fall(const Vec3& point, const Vec3& to_key) const;

    const Container container_;
    const MeshShadows meshes_;
    const Extent extent_;
    const Container foot_;  // what stands on the ground: the container, or the tray below it
    Eigen::Matrix3d level_;
    std::vector<Patch> walls_;
    std::vector<Vec3> reach_;                        // m, level: outermost points
    double height_ = 0, low_plate_ = 0, aside_ = 0;  // m; aside_: level stroke, as it is drawn
    double foot_half_ = 0;                           // m, half the width of the foot's plate along y
    double size_ = 1;                                // m, of the vessel
    Eigen::Vector2d low_{0, 0};
    double side_ = 1;
    std::vector<float> cells_, closed_, before_;
};

}  // namespace grainreel
