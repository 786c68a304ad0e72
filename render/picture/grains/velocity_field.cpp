#include "render/picture/grains/velocity_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double least_grains = 3;    // fewer grains make no mean
constexpr double most_cells = 20000;  // cells of a picture's field
constexpr double pi = std::numbers::pi;

// Hz: the inverse of the drive's last period.
double periods_a_second(const FilmedScene& scene, const State& frame) {
    if (!scene.drive.changes()) return scene.drive.frequency;
    const DriveSchedule schedule(scene.drive);
    return 1 / (schedule.times().time(frame.cycles) - schedule.times().time(frame.cycles - 1));
}

}  // namespace

FieldOutput picture_fields(const FilmedScene& scene, double width, double finest) {
    FieldOutput fields;
    const Vec3 size = extent_of(scene).size();
    fields.grid = FieldOutput::Grid::yz;
    fields.width = width;
    fields.cell = std::max(finest, std::sqrt(size.y() * size.z() / most_cells));
    return fields;
}

FieldState field_state_of(const FilmedScene& scene, const Shot& frame, bool period) {
    FieldState state;
    if (period && frame.displacement.size() != frame.size()) return state;
    const Vec3 way = way_of_container(scene, frame);
    const double frequency = period ? periods_a_second(scene, frame) : 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 velocity = period ? Vec3(frequency * frame.displacement[i]) : frame.velocity[i];
        if (velocity.hasNaN()) continue;
        const double volume = 4.0 / 3 * pi * std::pow(frame.radius[i], 3);
        const double density = scene.species[frame.species[i]].density;
        const double mass = frame.mass.empty() ? density * volume : frame.mass[i];
        state.grains.push_back(
            {frame.position[i] - way, velocity, mass, volume, frame.species[i], frame.radius[i]});
    }
    return state;
}

VelocityField::VelocityField(const FilmedScene& scene, double width, bool period)
    : scene_(scene),
      width_(width),
      period_(period),
      sums_(scene, picture_fields(scene, width, 0.5 * width), 1) {}

void VelocityField::take(const Shot& frame) {
    sums_.clear();
    sums_.add(field_state_of(scene_, frame, period_), 0);
    fields_ = sums_.mean();
}

// The kernel counts as covering an area of 4 pi w^2 of the plane, which is the inverse of the integral of its
// square. The number of grains under the kernel is the number in this area.
bool VelocityField::is_filled(std::size_t cell) const {
    if (std::isnan(fields_.velocity[0][cell])) return false;
    double grains = 0;  // grains in a cubic metre
    for (std::size_t s = 0; s < fields_.solid_fraction.size(); ++s)
        grains += fields_.solid_fraction[s][cell] / (pi / 6 * mean_cube(scene_.species[s].diameter));
    return grains * 4 * pi * width_ * width_ * sums_.grid().axes[0].cell >= least_grains;
}

std::optional<Vec3> VelocityField::at(double y, double z) const {
    if (fields_.velocity.empty()) return std::nullopt;
    const auto& [x_axis, y_axis, z_axis] = sums_.grid().axes;
    const double right = (y - y_axis.low) / y_axis.cell - 0.5, up = (z - z_axis.low) / z_axis.cell - 0.5;
    const auto j = static_cast<std::int64_t>(std::floor(right)),
               k = static_cast<std::int64_t>(std::floor(up));
    if (j < 0 || k < 0 || j + 1 >= y_axis.count || k + 1 >= z_axis.count) return std::nullopt;
    Vec3 sum = Vec3::Zero();
    double share = 0;
    for (const std::int64_t dj : {0, 1})
        for (const std::int64_t dk : {0, 1}) {
            const auto cell = static_cast<std::size_t>(sums_.grid().index(0, j + dj, k + dk));
            if (!is_filled(cell)) continue;
            const double beside = right - static_cast<double>(j), above = up - static_cast<double>(k);
            const double weight = (dj ? beside : 1 - beside) * (dk ? above : 1 - above);
            for (int a = 0; a < 3; ++a) sum[a] += weight * fields_.velocity[a][cell];
            share += weight;
        }
    if (share < 0.5) return std::nullopt;
    return sum / share;
}

}  // namespace grainreel
