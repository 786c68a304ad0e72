#include "engine/measure/measure.hpp"

#include <limits>

#include "engine/measure/energy.hpp"
#include "engine/measure/segregation.hpp"

namespace grainreel {

namespace {

double mean_diameter(const Species& s) {
    return 0.5 * (s.diameter.smallest + s.diameter.largest);
}

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

void measure_segregation(const Scene& scene, const Grains& grains, double floor_height, Measures& m) {
    std::size_t largest = 0, smallest = 0;
    for (std::size_t s = 1; s < scene.species.size(); ++s) {
        if (mean_diameter(scene.species[s]) > mean_diameter(scene.species[largest])) largest = s;
        if (mean_diameter(scene.species[s]) < mean_diameter(scene.species[smallest])) smallest = s;
    }
    if (scene.species.size() < 2) {
        m.height_difference = m.lacey = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    if (largest == smallest) smallest = largest == 0 ? 1 : 0;  // equal sizes: the first against the second
    std::vector<Vec3> position(grains.size());
    std::vector<std::uint8_t> marked(grains.size());
    std::vector<double> heights(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) {
        position[grains.id[i]] = grains.place[i].position;
        marked[grains.id[i]] = grains.species[i] == static_cast<std::int32_t>(largest);
        heights[i] = grains.place[i].position.z() - floor_height;
    }
    m.height_difference = (m.species_height[largest] - m.species_height[smallest]) / bed_height(heights);
    m.lacey = lacey_index(position, marked);
}

}  // namespace

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
    const Kinetic kinetic = kinetic_energy(grains);
    const ContactSummary contacts = summarise_contacts(loop, step);
    m.kinetic = kinetic.translation;
    m.rotational = kinetic.rotation;
    m.gravitational = gravitational_energy(grains, around.gravity);
    m.elastic = contacts.stored;
    m.wall_work = wall_work(grains);
    m.lost = start_energy + m.wall_work - m.kinetic - m.rotational - m.gravitational - m.elastic;
    m.contact_number = contacts.carrying / static_cast<double>(grains.size());
    m.largest_overlap = contacts.largest_overlap;
    const Pose pose = around.motion.at(step);
    m.floor_position = pose.offset.dot(scene.drive.direction);
    measure_species(scene, grains, pose.offset.z(), m);
    measure_segregation(scene, grains, pose.offset.z(), m);
    return m;
}

}  // namespace grainreel
