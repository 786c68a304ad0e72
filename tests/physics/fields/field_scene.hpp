// Small scenes with fields, put together by hand.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/measure/fields/coarse_graining.hpp"

namespace grainreel {

// A box with its floor's middle in the origin, one species, and kernels of this width on cells of this size.
inline Scene field_box(const Vec3& size, FieldOutput::Grid grid, double width, double cell) {
    Scene scene;
    scene.species.resize(1);
    scene.container.shape = Container::Shape::box;
    scene.container.depth = size.x();
    scene.container.half_width = size.y() / 2;
    scene.container.height = size.z();
    scene.output.fields.grid = grid;
    scene.output.fields.width = width;
    scene.output.fields.cell = cell;
    return scene;
}

inline FieldGrain sphere(const Vec3& position, double radius, double density,
                         const Vec3& velocity = Vec3::Zero(), std::int32_t species = 0) {
    const double volume = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
    return {position, velocity, density * volume, volume, species, radius};
}

// Spheres of diameter 1 and mass 1 that fill a box of side 5, five along each side.
inline FieldState cubic_packing() {
    FieldState state;
    for (int i = 0; i < 125; ++i)
        state.grains.push_back(
            sphere(Vec3(i % 5 - 2, i / 5 % 5 - 2, i / 25 + 0.5), 0.5, 6 / std::numbers::pi));
    return state;
}

// The sum of a field over the container, times the volume of the cells.
inline double integral(const CoarseGraining& by, const CellValues& field) {
    double sum = 0;
    for (std::size_t c = 0; c < field.size(); ++c) sum += field[c] * by.shares()[c];
    return sum * by.grid().cell_volume();
}

// The same sum over all cells, including those in the walls.
inline double padded_integral(const CoarseGraining& by, const CellValues& field) {
    double sum = 0;
    for (const double value : field) sum += value;
    return sum * by.grid().cell_volume();
}

}  // namespace grainreel
