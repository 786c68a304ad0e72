#include "engine/measure/segregation/unlike_neighbours.hpp"

#include "engine/base/numbers.hpp"

namespace grainreel {

namespace {

// Moments of the radii of some grains; the weights of all pairs follow from them.
struct Radii {
    double count = 0, sum = 0, squares = 0;

    void add(double radius) {
        count += 1;
        sum += radius;
        squares += radius * radius;
    }
    // Sum of (r_i + r_j)^2 over all pairs of these grains.
    double pairs() const { return (count - 2) * squares + sum * sum; }
};

double unlike_by_chance(const LargeArray<Place>& place, const std::vector<std::int32_t>& species) {
    Radii all;
    std::vector<Radii> of;
    for (std::size_t i = 0; i < place.size(); ++i) {
        const auto s = static_cast<std::size_t>(species[i]);
        if (s >= of.size()) of.resize(s + 1);
        of[s].add(place[i].radius);
        all.add(place[i].radius);
    }
    double like = 0;
    int kinds = 0;
    for (const Radii& radii : of) {
        like += radii.pairs();
        kinds += radii.count > 0;
    }
    return kinds > 1 ? 1 - like / all.pairs() : 0;
}

}  // namespace

double unlike_neighbours(const LargeArray<Place>& place, const std::vector<std::int32_t>& species, double gap,
                         double period) {
    if (place.size() < 2) return kUnknown;
    double unlike = 0, all = 0;
    NeighbourPairs(place, gap, period).each([&](std::int32_t a, std::int32_t b) {
        all += 1;
        unlike += species[a] != species[b];
    });
    const double chance = unlike_by_chance(place, species);
    if (all == 0 || chance == 0) return kUnknown;
    return unlike / all / chance;
}

}  // namespace grainreel
