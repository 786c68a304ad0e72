#include "render/picture/marks/field_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double strength = 0.8;      // of the layer; the grains are seen through it
constexpr double full_from = 0.3;     // solid fraction from which on it is as strong as that
constexpr double most_cells = 20000;  // of the picture

// Wider than fields in files are by default, since this one is of a single moment; finer cells for the eye.
FieldOutput resolution(const FilmedScene& scene) {
    FieldOutput fields;
    const double diameter = mean_diameter(scene);
    const Vec3 size = extent_of(scene).size();
    fields.grid = FieldOutput::Grid::yz;
    fields.width = 0.75 * diameter;
    fields.cell = std::max(0.25 * diameter, std::sqrt(size.y() * size.z() / most_cells));
    return fields;
}

}  // namespace

FieldLayer::FieldLayer(const FilmedScene& scene)
    : scene_(scene),
      grid_(make_field_grid(scene, resolution(scene))),
      shares_(inside_shares(grid_, scene)),
      footprint_(grid_, FieldKernel(FieldOutput::Kernel::gaussian, resolution(scene).width, 2)),
      quantities_(scene, scene.film.shows.colour.by),
      scale_(scene.film.shows.colour) {}

void FieldLayer::gather(const Frame& frame) {
    for (std::vector<double>* const sums : {&solid_, &mass_, &sum_}) sums->assign(shares_.size(), 0);
    const std::vector<double>& values = quantities_.of(frame);
    const Vec3 way = way_of_container(scene_, frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (std::isnan(values[i])) continue;
        const double volume = 4.0 / 3 * std::numbers::pi * std::pow(frame.radius[i], 3);
        const double mass = volume * scene_.species[static_cast<std::size_t>(frame.species[i])].density;
        for (const CellWeight& cell : footprint_.of_point(frame.position[i] - way)) {
            const auto c = static_cast<std::size_t>(cell.cell);
            solid_[c] += cell.weight * volume;
            mass_[c] += cell.weight * mass;
            sum_[c] += cell.weight * mass * values[i];
        }
    }
}

void FieldLayer::draw(const View& view, const Frame& frame, Shapes& on) {
    gather(frame);
    const auto& [x, y, z] = grid_.axes;
    const Vec3 way = way_of_container(scene_, frame);
    const auto corner = [&](std::int64_t j, std::int64_t k) {
        const Vec3 at(x.low + x.cell, y.low + static_cast<double>(j) * y.cell,
                      z.low + static_cast<double>(k) * z.cell);
        return view.project(at + way);
    };
    for (std::int64_t k = 0; k < z.count; ++k)
        for (std::int64_t j = 0; j < y.count; ++j) {
            const auto c = static_cast<std::size_t>(grid_.index(0, j, k));
            if (mass_[c] <= 0 || shares_[c] < 0.5) continue;
            const double mean = sum_[c] / mass_[c];
            clipped_.take(mean, {scale_.low(), scale_.high()});
            const double alpha = strength * std::min(1.0, solid_[c] / full_from);
            on.polygon({corner(j, k), corner(j + 1, k), corner(j + 1, k + 1), corner(j, k + 1)},
                       {scale_.at(mean), alpha});
        }
}

}  // namespace grainreel
