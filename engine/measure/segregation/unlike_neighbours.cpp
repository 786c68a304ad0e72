#include "engine/measure/segregation/unlike_neighbours.hpp"

#include <limits>

#include "engine/base/nearest_image.hpp"
#include "engine/step/grid/cells.hpp"

namespace grainreel {

namespace {

// In the order of the cells, which find partners fast only there.
struct Ordered {
    LargeArray<Place> place;
    std::vector<std::int32_t> species;
};

Ordered put_in_order(Cells& cells, const LargeArray<Place>& place, const std::vector<std::int32_t>& species,
                     double gap, double period) {
    LargeArray<Place> wrapped = place;
    if (period > 0) {
        for (Place& p : wrapped) p.position.x() = nearest_image(p.position.x(), period);
    }
    cells.order(wrapped, gap, period);
    Ordered grains;
    for (const std::int32_t old : cells.in_order()) {
        grains.place.push_back(wrapped[old]);
        grains.species.push_back(species[old]);
    }
    cells.lay(grains.place, gap);
    return grains;
}

bool are_neighbours(const Place& a, const Place& b, double gap, double period) {
    Vec3 apart = a.position - b.position;
    apart.x() = nearest_image(apart.x(), period);
    const double reach = a.radius + b.radius + gap;
    return apart.squaredNorm() < reach * reach;
}

struct Pairs {
    double unlike = 0, all = 0;
};

Pairs count_neighbours(const Cells& cells, const Ordered& grains, double gap, double period) {
    Pairs pairs;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(grains.place.size()); ++i) {
        const Place& own = grains.place[i];
        for (const Cells::Level& level : cells.levels()) {
            level.grid.near(
                own.position, own.radius + gap + level.largest, level.leads,
                [&](const std::int32_t* first, const std::int32_t* last) {
                    for (; first < last; ++first) {
                        if (*first <= i || !are_neighbours(own, grains.place[*first], gap, period)) continue;
                        pairs.all += 1;
                        pairs.unlike += grains.species[*first] != grains.species[i];
                    }
                });
        }
    }
    return pairs;
}

// Moments of the radii of some grains; the weights of all pairs follow from them.
struct Radii {
    double count = 0, sum = 0, squares = 0;

    void add(double radius) {
        count += 1;
        sum += radius;
        squares += radius * radius;
    }
    // Sum of (r_i + r_j)^2 over all pairs among them.
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
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (place.size() < 2) return none;
    Cells cells;
    const Ordered grains = put_in_order(cells, place, species, gap, period);
    const Pairs pairs = count_neighbours(cells, grains, gap, period);
    const double chance = unlike_by_chance(place, species);
    if (pairs.all == 0 || chance == 0) return none;
    return pairs.unlike / pairs.all / chance;
}

}  // namespace grainreel
