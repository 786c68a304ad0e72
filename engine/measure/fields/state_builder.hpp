// From a moment of a run to what coarse-graining takes.
#pragma once

#include "engine/base/numbers.hpp"
#include "engine/measure/fields/field_state.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel {

// Places and velocities are seen from the container where the drive moves it, and from the lab where it moves
// the floor alone.
inline Pose seen_from(const Moment& moment) {
    return moment.scene.drive.moves == Drive::Moves::container ? moment.pose : Pose();
}

inline Vec3 field_place(const Moment& moment, std::size_t grain) {
    Vec3 place = moment.grains.place[grain].position;
    place.x() = nearest_image(place.x(), moment.period);
    return place - seen_from(moment).offset;
}

inline FieldGrain field_grain(const Moment& moment, std::size_t grain) {
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
inline FieldContact field_contact(const Moment& moment, const ContactView& contact) {
    const auto first = static_cast<std::size_t>(contact.first);
    const bool pair = contact.second >= 0;
    const double radius = moment.grains.place[first].radius;
    const double other = pair ? moment.grains.place[static_cast<std::size_t>(contact.second)].radius : 0;
    return {field_place(moment, first), (radius - contact.overlap + other) * contact.normal,
            contact.normal_force * contact.normal + contact.tangential, radius, pair ? other : radius};
}

}  // namespace grainreel
