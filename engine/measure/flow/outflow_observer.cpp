#include "engine/measure/flow/outflow_observer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/mathematics.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

WideInt total(const MassCounts& counts) {
    return std::accumulate(counts.begin(), counts.end(), WideInt{0});
}

double mass_quantum(double largest) {
    return largest > 0 ? std::ldexp(math::power_of_two_from(largest), -60) : 1;
}

WideInt mass_count(double mass, double quantum) {
    return std::llrint(mass / quantum);
}

double largest_mass(const Scene& scene) {
    Grains one;
    double largest = 0;
    for (const Species& species : scene.species) {
        if (!(species.diameter.largest > 0)) continue;
        one.add(0, 0, Vec3::Zero(), 0.5 * species.diameter.largest, species.density);
        largest = std::max(largest, one.mass(one.size() - 1));
    }
    return largest;
}

const MassCounts& FedMass::of(std::span<const std::int64_t> given, double quantum) {
    if (quantum != quantum_) given_.clear();
    if (given_.empty()) {
        quantum_ = quantum;
        given_.assign(given.size(), 0);
        sums_.assign(scene_.species.size(), 0);
    }
    Grains one;
    one.add(0, 0, Vec3::Zero(), 1, 1);
    for (std::size_t feed = 0; feed < given.size(); ++feed)
        for (std::int64_t& next = given_[feed]; next < given[feed]; ++next) {
            const ComingGrain grain = fed_grain(scene_, feed, next);
            one.set_radius(0, grain.radius, grain.density);
            sums_[grain.species] += mass_count(one.mass(0), quantum);
        }
    return sums_;
}

}  // namespace grainreel
