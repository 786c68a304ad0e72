#include "engine/start/weight_moments.hpp"

#include <algorithm>
#include <limits>

namespace grainreel {

WeightMoments::WeightMoments(const Vec3& gravity, const Grains& grains) : grains_(grains) {
    if (gravity.norm() > 0) up_ = -gravity / gravity.norm();
    lowest_ = std::numeric_limits<double>::infinity();
    for (const Place& p : grains.place) lowest_ = std::min(lowest_, up_.dot(p.position) - p.radius);
    for (std::size_t i = 0; i < grains.size(); ++i)
        of_weights_ += grains.mass(i) * gravity.norm() * height(grains.place[i].position);
}

double WeightMoments::carried(const ContactView& contact) const {
    const Place& first = grains_.place[contact.first];
    const double along = up_.dot(contact.normal);
    // On the first body the force points against the normal.
    if (contact.second < 0) return -along * height(first.position);
    return along * along * (first.radius + grains_.place[contact.second].radius - contact.overlap);
}

}  // namespace grainreel
