#include "render/picture/container/exit_fade.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/drive/drive_schedule.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double begins_at = 0.5;  // of the way from the floor to where grains leave
constexpr double least_rows = 4;

// Pixels from the top, of the lowest point that the floor's plate has in the course of the film.
double lowest_of_floor(const FilmedScene& scene, const View& view) {
    const Container& c = scene.container;
    const double thick = 1.4 * drawn_thickness(c);
    const double stroke = scene.drive.present ? drive_peaks(scene.drive).offset : 0;
    const double x = (c.shape == Container::Shape::cylinder ? c.half_width : 0.5 * c.depth) + thick,
                 y = c.floor_half_width() + thick;
    double lowest = 0;
    for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0})
            lowest = std::max(lowest, view.project(Vec3(side * x, end * y, -thick - stroke)).y());
    return lowest;
}

}  // namespace

std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height) {
    const Container& c = scene.container;
    if (!c.outlet || c.tray) return {};
    const double depth = c.outlet->exit_depth;
    const double end = view.project(Vec3(0, 0, -depth)).y();
    const double begin =
        std::max(view.project(Vec3(0, 0, -begins_at * depth)).y(), lowest_of_floor(scene, view));
    if (!std::isfinite(begin) || !std::isfinite(end) || end - begin < least_rows) return {};
    std::vector<std::uint32_t> rows;
    for (int y = 0; y < height; ++y)
        rows.push_back(static_cast<std::uint32_t>(
            std::lround(255 * std::clamp((end - y - 0.5) / (end - begin), 0.0, 1.0))));
    return rows;
}

}  // namespace grainreel
