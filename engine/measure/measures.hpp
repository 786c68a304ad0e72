// The numbers of one instant: one row of measures.csv.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

struct Measures {
    std::int64_t step = 0;
    double time = 0;   // s
    double phase = 0;  // turns
    double cycles = 0;

    // J. `elastic` is what the contacts would give back; `wall_work` was done by moving walls on the grains
    // since the drive started; `lost` is what the balance leaves: start + wall_work - all the others.
    double kinetic = 0, rotational = 0, gravitational = 0, elastic = 0, wall_work = 0, lost = 0;

    Vec3 centre_of_mass{0, 0, 0};        // m, all grains
    std::vector<Vec3> species_centre;    // m, a species each
    std::vector<double> species_height;  // m, mean height above the moving floor, a species each

    // NaN with one species. `big` and `small`: the species of the largest and of the smallest mean diameter.
    double height_difference = 0;   // (mean height of big - of small) / bed height
    double big_above_small = 0;     // probability that a big grain lies above a small one
    double big_in_top_quarter = 0;  // share of the big ones above 3/4 of the bed height
    double unlike_neighbours = 0;   // over chance: 0 segregated, 1 random
    double lacey = 0;               // mixing index: 0 segregated, 1 random; NaN too where one kind is rare

    double contact_number = 0;   // mean number of force-carrying contacts a grain, walls included
    double largest_overlap = 0;  // overlap / smaller radius
    double floor_position = 0;   // m, along the drive's direction
    int bed_periods =
        0;  // of the drive, after which the bed repeats itself (PeriodMultiple); 0 without a drive
};

// One number a column of measures.csv, in the order of measure_columns().
std::vector<double> values_of(const Measures& measures);

}  // namespace grainreel
