// A velocity field on equal cells of a plane, and what turns in it.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/measure/no_value.hpp"

namespace grainreel {

// Cells in (y, z), y to the right and z up; cell (j, k) at index j + k * across. Any unit of speed: m/s, or m
// a period.
struct VelocityGrid {
    std::size_t across = 0, high = 0;
    double left = 0, bottom = 0;    // m, the corner of the first cell
    double width = 0, height = 0;   // m, of a cell
    std::vector<double> right, up;  // mean velocity in a cell
    std::vector<double> weight;     // how much there is of it (grains, mass); 0 where the cell is empty

    std::size_t index(std::size_t j, std::size_t k) const { return j + k * across; }
    double y(std::size_t j) const { return left + (static_cast<double>(j) + 0.5) * width; }  // of the middle
    double z(std::size_t k) const { return bottom + (static_cast<double>(k) + 0.5) * height; }  // m
};

struct Circulation {
    double along = 0;  // closed integral of u . dl, speed times m; positive counter-clockwise (y to z)
    double edge = 0;   // m, length of the closed line
    double area = 0;   // m2, inside it
    // Mean velocity along the line; NaN without one.
    double speed() const { return along / edge; }
};

// Around the part of the field whose cells are filled and have their middles from y = from to y = to. By
// Stokes' theorem the integral around it is the sum of the integrals around all squares between the middles
// of four filled cells, each by the trapezoidal rule, which is exact where u is linear. A rigid rotation by w
// has 2 w times the area.
Circulation circulation(const VelocityGrid& grid, double from, double to);

// psi at the right edge of each cell, by rows as in the grid: what flows up through the row between the left
// side and there, -psi = sum of weight * up * cell width, over the mean weight of the filled cells (speed
// times m). In a steady field no more flows up through a row than down; what is left over by scatter is
// spread evenly over the row's weight, so that psi is 0 at the right side.
std::vector<double> stream_function(const VelocityGrid& grid);

struct RollCentre {
    double y = kNoValue, z = kNoValue;  // m
    double psi = 0;                     // speed times m; positive where the field turns counter-clockwise
};

// Where |psi| is largest between y = from and y = to; NaN where nothing turns.
RollCentre roll_centre(const VelocityGrid& grid, const std::vector<double>& psi, double from, double to);

}  // namespace grainreel
