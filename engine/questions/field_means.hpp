// Means of the records of fields.nc over any span of time: on the grid of the run, or over rings about the
// axis of a cylinder (r and z). Also how long the flow takes to turn the bed over.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/column_figures.hpp"

namespace grainreel {

// Means over time on a grid of cells. Densities, fractions and stresses are means over volume, velocities and
// temperatures over mass.
struct MeanFields {
    std::vector<std::string> names;  // "density"; without free_volume
    std::array<std::vector<double>, 3>
        middles;                              // m, of the cells along x, y, z; an axis without cells has none
    std::vector<double> volume;               // m3, of each cell inside the container; x fastest, then y
    std::vector<std::vector<double>> values;  // by name; NaN where there are no grains
    double from = 0, to = 0;                  // s
    std::size_t records = 0;

    // The values of that name; throws UserError where there are none.
    const std::vector<double>& of(const std::string& name) const;
};

// The means over the rings of each height. Only of fields in three dimensions. velocity_r is away from the
// axis.
struct RingFields {
    std::vector<double> r, z;  // m, the middle of each ring; r fastest
    std::vector<std::string> names;
    std::vector<std::vector<double>> values;  // by name
};
RingFields rings_of(const MeanFields& fields);

// How long (s) the mean flow needs to carry the mass of the bed once through the height at which it rises
// most: the mass over the mass that rises there in a second. NaN where nothing rises.
double turnover_time(const MeanFields& fields);

// grid: "kept", or "rz" for rings. Throws UserError where the run has no fields.nc, or no record that lies
// within the window.
Answer fields_answer(const StoredRun& run, const std::string& grid, const TimeWindow& window);

}  // namespace grainreel
