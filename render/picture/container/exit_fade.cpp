#include "render/picture/container/exit_fade.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
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

// From where to where grains fall and leave, m, and the row in which the lowest wall ends.
struct Fall {
    Vec3 from, to;
    double lowest_row;
};

std::optional<Fall> fall_below_outlet(const FilmedScene& scene, const View& view) {
    const Container& c = scene.container;
    if (!c.outlet || c.tray) return std::nullopt;
    return Fall{Vec3(0, 0, 0), Vec3(0, 0, -c.outlet->exit_depth), lowest_of_floor(scene, view)};
}

// Where they leave below all meshes.
std::optional<Fall> fall_into_exit(const FilmedScene& scene, const View& view,
                                   const std::vector<Vec3>& meshes) {
    const std::optional<double> end = exit_level(scene);
    if (!end || meshes.empty()) return std::nullopt;
    double lowest = meshes.front().z(), row = 0;
    for (const Vec3& point : meshes) {
        lowest = std::min(lowest, point.z());
        row = std::max(row, view.project(point).y());
    }
    if (*end >= lowest) return std::nullopt;
    const Vec3 middle = extent_of(scene).middle();
    return Fall{{middle.x(), middle.y(), lowest}, {middle.x(), middle.y(), *end}, row};
}

}  // namespace

std::optional<double> exit_level(const FilmedScene& scene) {
    std::optional<double> level;
    for (const ExitBox& box : scene.exits) {
        const double here = box.outside ? box.low.z() : box.high.z();
        level = std::max(level.value_or(here), here);
    }
    return level;
}

std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height,
                                     const std::vector<Vec3>& meshes) {
    std::optional<Fall> fall = fall_below_outlet(scene, view);
    if (!fall) fall = fall_into_exit(scene, view, meshes);
    if (!fall) return {};
    const double end = view.project(fall->to).y();
    const double half_way = view.project(fall->from + begins_at * (fall->to - fall->from)).y();
    const double begin = std::max(half_way, fall->lowest_row);
    if (!std::isfinite(begin) || !std::isfinite(end) || end - begin < least_rows) return {};
    std::vector<std::uint32_t> rows;
    for (int y = 0; y < height; ++y)
        rows.push_back(static_cast<std::uint32_t>(
            std::lround(255 * std::clamp((end - y - 0.5) / (end - begin), 0.0, 1.0))));
    return rows;
}

}  // namespace grainreel
