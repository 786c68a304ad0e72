#include "engine/state/grains.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <type_traits>

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

// Sets values[i] = values[order[i]], but only the bytes [offset, offset + size) of each value. Each member of
// the team copies its part, in the new order, into the memory `room`. When all members have done so, it
// copies its part back.
template <std::size_t offset, std::size_t size, class Value>
void reorder_bytes(Value* values, const std::vector<std::int32_t>& order, LargeArray<Load>& room,
                   const TeamMember& me) {
    static_assert(size <= sizeof(Load));
    const auto [begin, end] = me.part_of(order.size());
    auto* const bytes = reinterpret_cast<std::byte*>(values) + offset;
    auto* const own = reinterpret_cast<std::byte*>(room.data() + begin);
    for (std::int32_t i = begin; i < end; ++i)
        std::memcpy(own + (i - begin) * size, bytes + order[i] * sizeof(Value), size);
    me.wait();
    for (std::int32_t i = begin; i < end; ++i)
        std::memcpy(bytes + i * sizeof(Value), own + (i - begin) * size, size);
}

}  // namespace

void Grains::reorder(const std::vector<std::int32_t>& order, const TeamMember& me) {
    const auto reorder_all = [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (!values.empty()) reorder_bytes<0, sizeof(Value)>(values.data(), order, load, me);
    };
    reorder_all(id), reorder_all(species), reorder_all(wall_work);
    reorder_all(place), reorder_all(motion), reorder_all(rounded), reorder_all(orientation);
    if (!derivatives.empty()) {
        constexpr std::size_t half = sizeof(Derivatives) / 2;
        reorder_bytes<0, half>(derivatives.data(), order, load, me);
        reorder_bytes<half, half>(derivatives.data(), order, load, me);
    }
    const auto [begin, end] = me.part_of(order.size());
    std::fill(load.begin() + begin, load.begin() + end, Load{});
}

}  // namespace grainreel
