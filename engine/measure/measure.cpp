#include "engine/measure/measure.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/segregation.hpp"
#include "engine/measure/unlike_neighbours.hpp"

namespace grainreel {

namespace {

void measure_species(const Scene& scene, const Grains& grains, double floor_height, Measures& m) {
    const std::size_t species = scene.species.size();
    m.species_centre.assign(species, Vec3::Zero());
    m.species_height.assign(species, 0);
    std::vector<double> count(species, 0);
    double mass = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const std::int32_t s = grains.species[i];
        const Vec3& x = grains.place[i].position;
        m.species_centre[s] +=
            x;  // all grains of a species weigh alike here, also when their sizes are spread
        m.species_height[s] += x.z() - floor_height;
        count[s] += 1;
        m.centre_of_mass += grains.mass(i) * x;
        mass += grains.mass(i);
    }
    m.centre_of_mass /= mass;
    for (std::size_t s = 0; s < species; ++s) {
        m.species_centre[s] /= count[s];
        m.species_height[s] /= count[s];
    }
}

double share_higher_than(double limit, const std::vector<double>& heights) {
    const auto higher = std::count_if(heights.begin(), heights.end(), [&](double h) { return h > limit; });
    return static_cast<double>(higher) / static_cast<double>(heights.size());
}

void measure_heights(const Grains& grains, const BigAndSmall& kinds, double floor_height, Measures& m) {
    std::vector<double> all, big, small;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const double height = grains.place[i].position.z() - floor_height;
        const auto species = static_cast<std::size_t>(grains.species[i]);
        all.push_back(height);
        if (species == kinds.big) big.push_back(height);
        if (species == kinds.small) small.push_back(height);
    }
    const double bed = bed_height(all);
    m.height_difference = (m.species_height[kinds.big] - m.species_height[kinds.small]) / bed;
    m.big_above_small = share_above(big, small);
    m.big_in_top_quarter = share_higher_than(0.75 * bed, big);
}

double lacey_of(const Grains& grains, const BigAndSmall& kinds) {
    std::vector<std::size_t> by_id(grains.size());
    std::iota(by_id.begin(), by_id.end(), std::size_t{0});
    std::sort(by_id.begin(), by_id.end(), [&](auto a, auto b) { return grains.id[a] < grains.id[b]; });
    std::vector<Vec3> position;
    std::vector<std::uint8_t> marked;
    for (const std::size_t i : by_id) {
        position.push_back(grains.place[i].position);
        marked.push_back(static_cast<std::size_t>(grains.species[i]) == kinds.big);
    }
    return lacey_index(position, marked);
}

void measure_segregation(const Scene& scene, const Surroundings& around, const Grains& grains,
                         double floor_height, Measures& m) {
    if (scene.species.size() < 2 || grains.size() == 0) {
        m.height_difference = m.big_above_small = m.big_in_top_quarter = m.unlike_neighbours = m.lacey =
            std::numeric_limits<double>::quiet_NaN();
        return;
    }
    const BigAndSmall kinds = big_and_small(scene.species);
    measure_heights(grains, kinds, floor_height, m);
    const double gap = kNeighbourGap * scene.species[kinds.small].diameter.mean;
    m.unlike_neighbours = unlike_neighbours(grains.place, grains.species, gap, around.period);
    m.lacey = lacey_of(grains, kinds);
}

}  // namespace

BigAndSmall big_and_small(const std::vector<Species>& species) {
    GRAINREEL_CHECK(species.size() > 1);
    BigAndSmall kinds;
    for (std::size_t s = 1; s < species.size(); ++s) {
        if (species[s].diameter.mean > species[kinds.big].diameter.mean) kinds.big = s;
        if (species[s].diameter.mean < species[kinds.small].diameter.mean) kinds.small = s;
    }
    if (kinds.big == kinds.small) kinds.small = 1;
    return kinds;
}

double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step) {
    const Kinetic kinetic = kinetic_energy(grains);
    return kinetic.translation + kinetic.rotation + gravitational_energy(grains, around.gravity) +
           summarise_contacts(loop, step).stored;
}

Measures measure(const Scene& scene, const Clock& clock, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step, double start_energy) {
    Measures m;
    m.step = step;
    m.time = clock.time(step);
    m.phase = clock.phase(step);
    m.cycles = clock.cycles(step);
    m.bed_periods = clock.steps_per_period > 0 ? 1 : 0;
    const Kinetic kinetic = kinetic_energy(grains);
    const ContactSummary contacts = summarise_contacts(loop, step);
    m.kinetic = kinetic.translation;
    m.rotational = kinetic.rotation;
    m.gravitational = gravitational_energy(grains, around.gravity);
    m.elastic = contacts.stored;
    const Traffic& traffic = loop.traffic();
    m.wall_work = wall_work(grains) + traffic.work_out;
    m.lost = start_energy + traffic.energy_in - traffic.energy_out + m.wall_work - m.kinetic - m.rotational -
             m.gravitational - m.elastic;
    m.contact_number = contacts.carrying / static_cast<double>(grains.size());
    m.largest_overlap = contacts.largest_overlap;
    const Pose pose = around.motion.at(step);
    m.floor_position = pose.offset.dot(scene.drive.direction);
    measure_species(scene, grains, pose.offset.z(), m);
    measure_segregation(scene, around, grains, pose.offset.z(), m);
    return m;
}

}  // namespace grainreel
