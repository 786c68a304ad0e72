// The input of fields: the grains and contacts of one moment, seen from the container.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/base/vector.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel {

struct FieldGrain {
    Vec3 position;  // m
    Vec3 velocity;  // m/s
    double mass;    // kg
    double volume;  // m3
    std::int32_t species;
    double radius = 0;  // m, least width of its kernel; 0 for a point
};

// A contact of a grain with another grain or a wall.
struct FieldContact {
    Vec3 begin;   // m, the grain's centre
    Vec3 branch;  // m, from there to the other grain's centre, or to the point of the wall that it touches
    Vec3 force;   // N, on the other body
    double radius = 0, other_radius = 0;  // m, of both grains; at a wall both are the grain's
};

struct FieldState {
    std::vector<FieldGrain> grains;
    std::vector<FieldContact> contacts;
};

// Makes the input of coarse-graining from a moment of a run.

// Pose relative to which places and velocities are given. It is the container's if the drive moves the
// container, and that of the lab if the drive moves only the floor.
inline Pose seen_from(const ObservedState& moment) {
    return moment.scene.drive.moves == Drive::Moves::container ? moment.pose : Pose();
}

inline Vec3 field_place(const ObservedState& moment, std::size_t grain) {
    Vec3 place = moment.grains.place[grain].position;
    place.x() = nearest_image(place.x(), moment.period);
    return place - seen_from(moment).offset;
}

inline FieldGrain field_grain(const ObservedState& moment, std::size_t grain) {
    const std::int32_t species = moment.grains.species[grain];
    const double mass = moment.grains.mass(grain);
    return {field_place(moment, grain),
            moment.grains.motion[grain].velocity - seen_from(moment).velocity,
            mass,
            mass / moment.scene.species[static_cast<std::size_t>(species)].density,
            species,
            moment.grains.place[grain].radius};
}

// At a wall the branch ends on the wall's face.
inline FieldContact field_contact(const ObservedState& moment, const ContactView& contact) {
    const auto first = static_cast<std::size_t>(contact.first);
    const bool pair = contact.second >= 0;
    const double radius = moment.grains.place[first].radius;
    const double other = pair ? moment.grains.place[static_cast<std::size_t>(contact.second)].radius : 0;
    return {field_place(moment, first), (radius - contact.overlap + other) * contact.normal,
            contact.normal_force * contact.normal + contact.tangential, radius, pair ? other : radius};
}

}  // namespace grainreel
