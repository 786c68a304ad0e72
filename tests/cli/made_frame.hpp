// Frames and measures with numbers that no two fields share and that need every digit of a double.
#pragma once

#include <cmath>

#include "engine/frame.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel::test {

inline Vec3 vector_of(double seed) {
    return {std::sin(seed), std::cos(3 * seed) * 1e-9, -std::exp(seed / 7)};
}

inline Frame made_frame(int grains, int number, bool orientation = false) {
    Frame f;
    f.step = (std::int64_t{1} << 40) + number;  // more than 32 bits
    f.time = number / 3.0;
    f.cycles = number / 7.0;
    f.phase = f.cycles - std::floor(f.cycles);
    f.container().place = vector_of(number + 0.1);
    f.container().velocity = vector_of(number + 0.2);
    f.floor().place = vector_of(number + 0.3);
    f.floor().velocity = vector_of(number + 0.4);
    for (int i = 0; i < grains; ++i) {
        f.id.push_back(2 * i + 1);  // ids need not be dense
        f.species.push_back(i % 3);
        f.radius.push_back(0.0025 + i / 3e5);
        f.position.push_back(vector_of(number + i / 11.0));
        f.velocity.push_back(vector_of(number + i / 13.0));
        f.spin.push_back(vector_of(number + i / 17.0));
        if (orientation) f.orientation.push_back(Quaternion(i + 1.0, 2, number, -1).normalized());
    }
    return f;
}

// Of two species.
inline Measures made_measures(int number) {
    Measures m;
    m.step = number;
    m.time = number / 3.0;
    m.phase = number / 11.0;
    m.cycles = number / 7.0;
    m.kinetic = 1e-7 / (number + 1);
    m.rotational = 2e-7 / (number + 1);
    m.gravitational = 3e-7 / (number + 1);
    m.elastic = 4e-7 / (number + 1);
    m.wall_work = 5e-7 / (number + 1);
    m.lost = -1e-17;
    m.centre_of_mass = vector_of(number);
    m.species_centre = {vector_of(number + 1), vector_of(number + 2)};
    m.species_height = {number + 0.1, number + 0.2};
    m.height_difference = 0.1 * number - 1.0 / 3;
    m.big_above_small = 1.0 / 19;
    m.big_in_top_quarter = 1.0 / 17;
    m.unlike_neighbours = 1.0 / 13;
    m.lacey = 1.0 / 7;
    m.contact_number = number + 0.3;
    m.largest_overlap = 1e-4 / (number + 3);
    m.floor_position = -0.3;
    m.bed_periods = number + 2;
    return m;
}

}  // namespace grainreel::test
