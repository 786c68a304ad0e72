#include "engine/measure/measures.hpp"

namespace grainreel {

std::vector<double> values_of(const Measures& m) {
    std::vector<double> values{static_cast<double>(m.step), m.time, m.phase, m.cycles};
    const auto add = [&](std::initializer_list<double> more) {
        values.insert(values.end(), more.begin(), more.end());
    };
    add({m.kinetic, m.rotational, m.gravitational, m.elastic, m.wall_work, m.lost});
    add({m.centre_of_mass.x(), m.centre_of_mass.y(), m.centre_of_mass.z()});
    for (std::size_t s = 0; s < m.species_centre.size(); ++s) {
        const Vec3& centre = m.species_centre[s];
        add({centre.x(), centre.y(), centre.z(), m.species_height[s]});
    }
    add({m.height_difference, m.big_above_small, m.big_in_top_quarter, m.unlike_neighbours, m.lacey});
    add({m.contact_number, m.largest_overlap, m.floor_position, static_cast<double>(m.bed_periods)});
    return values;
}

}  // namespace grainreel
