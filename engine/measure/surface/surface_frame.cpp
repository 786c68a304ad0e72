#include "engine/measure/surface/surface_frame.hpp"

#include "engine/measure/walls/turning.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

constexpr double kSettled = 0.6;  // solid fraction of a bed at rest

}  // namespace

SurfaceFrame surface_frame(const Scene& scene) {
    SurfaceFrame frame;
    const Container& c = scene.container;
    if (c.shape == Container::Shape::none || turns_over(scene)) return frame;
    frame.diameter = mean_diameter(scene);
    const double filled = fill_height(scene, kSettled);
    frame.right = c.half_width_at(filled);
    frame.left = -frame.right;
    frame.front = c.shape == Container::Shape::cylinder ? c.half_width
                  : c.shape == Container::Shape::mesh   ? c.room->half_depth_at(filled)
                                                        : 0.5 * c.depth;
    frame.back = -frame.front;
    frame.period = period_of_depth(c);
    return frame;
}

}  // namespace grainreel
