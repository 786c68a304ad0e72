// How much of a picture the vessel takes, for the test of layouts and for tests/bench/framing.cpp.
#pragma once

#include <algorithm>

#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel::test {

// Shares of the picture's width and height.
struct SeenBox {
    double width = 0,
           height = 0;          // of all that has to be seen, and of the vessel as far as the port shows it
    double below = 0;           // free height of the port below them
    bool cut_by_words = false;  // whether the vessel ends at words above it
    double area() const { return width * height; }
};

inline SeenBox seen_box(const FilmedScene& scene, const PictureLayout& layout) {
    const View view = frame_container(scene, layout);
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const Vec3& point : framing_points(scene)) {
        low = low.cwiseMin(view.project(point));
        high = high.cwiseMax(view.project(point));
    }
    double top = 1e9;  // of the whole vessel
    for (const Vec3& point :
         framing_points(scene, scene.film.camera.azimuth, whole_container(scene), mesh_reach(scene)))
        top = std::min(top, view.project(point).y());
    if (framed_part(scene).cut) low.y() = std::min(low.y(), top);
    const double wide = scene.film.width, tall = scene.film.height;
    SeenBox box;
    box.width = (std::min(high.x(), 1.0 * layout.port.width) - std::max(low.x(), 0.0)) / wide;
    box.height = (std::min(high.y(), 1.0 * layout.port.height) - std::max(low.y(), 0.0)) / tall;
    box.below = (layout.port.height - high.y()) / tall;
    box.cut_by_words = top < -1 && layout.port.y > 0;
    return box;
}

}  // namespace grainreel::test
