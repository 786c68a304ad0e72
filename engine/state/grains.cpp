#include "engine/state/grains.hpp"

#include <tuple>
#include <type_traits>

#include <numbers>

namespace grainreel {

void Grains::reserve(std::size_t count) {
    id.reserve(count), species.reserve(count);
    place.reserve(count), motion.reserve(count), load.reserve(count);
    wall_work.reserve(count);
}

void Grains::add(std::int32_t grain_id, std::int32_t grain_species, const Vec3& position, double radius,
                 double density) {
    id.push_back(grain_id);
    species.push_back(grain_species);
    place.push_back({position, radius});
    motion.push_back({Vec3::Zero(), 0, Vec3::Zero(), 0});
    load.push_back({});
    wall_work.push_back(0);
    set_radius(size() - 1, radius, density);
}

void Grains::set_radius(std::size_t i, double radius, double density) {
    const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    place[i].radius = radius;
    motion[i].inverse_mass = 1 / mass;
    motion[i].inverse_inertia = 1 / (0.4 * mass * radius * radius);
}

namespace {

// values[i] = values[order[i]] for all of them at once, in place: along the cycles of the order.
template <class... Vectors>
void permute(const std::vector<std::int32_t>& order, std::vector<bool>& placed, Vectors&... values) {
    placed.assign(order.size(), false);
    const auto lift = [](const auto& of, std::size_t i) {
        return of.empty() ? typename std::decay_t<decltype(of)>::value_type{} : of[i];
    };
    const auto put = [](auto& to, std::size_t i, const auto& value) {
        if (!to.empty()) to[i] = value;
    };
    const auto move = [](auto& of, std::size_t from, std::size_t to) {
        if (!of.empty()) of[to] = of[from];
    };
    for (std::size_t begin = 0; begin < order.size(); ++begin) {
        if (placed[begin]) continue;
        const std::tuple lifted{lift(values, begin)...};
        std::size_t to = begin;
        for (std::size_t from = order[to]; from != begin; from = order[to]) {
            (move(values, from, to), ...);
            placed[to] = true;
            to = from;
        }
        placed[to] = true;
        std::apply([&](const auto&... value) { (put(values, to, value), ...); }, lifted);
    }
}

}  // namespace

void Grains::reorder(const std::vector<std::int32_t>& order) {
    permute(order, placed, id, species, place, motion, load, rounded, wall_work, orientation, derivatives);
}

}  // namespace grainreel
