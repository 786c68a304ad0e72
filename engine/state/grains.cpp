#include "engine/state/grains.hpp"

#include <numbers>

namespace grainreel {

void Grains::add(std::int32_t grain_id, std::int32_t grain_species, const Vec3& position, double radius,
                 double density) {
    id.push_back(grain_id);
    species.push_back(grain_species);
    place.push_back({position, radius});
    motion.push_back({Vec3::Zero(), 0});
    spin.push_back({Vec3::Zero(), 0});
    load.push_back({});
    wall_work.push_back(0);
    set_radius(size() - 1, radius, density);
}

void Grains::set_radius(std::size_t i, double radius, double density) {
    const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    place[i].radius = radius;
    motion[i].inverse_mass = 1 / mass;
    spin[i].inverse_inertia = 1 / (0.4 * mass * radius * radius);
}

namespace {

template <class T>
void permute(std::vector<T>& values, const std::vector<std::int32_t>& order) {
    if (values.empty()) return;
    std::vector<T> old(values.size());
    old.swap(values);
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = old[order[i]];
}

}  // namespace

void Grains::reorder(const std::vector<std::int32_t>& order) {
    permute(id, order);
    permute(species, order);
    permute(place, order);
    permute(motion, order);
    permute(spin, order);
    permute(load, order);
    permute(wall_work, order);
    permute(orientation, order);
    permute(derivatives, order);
}

}  // namespace grainreel
