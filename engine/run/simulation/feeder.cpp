#include "engine/run/simulation/feeder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/start/free_places.hpp"
#include "engine/step/fed_grain.hpp"

namespace grainreel {
namespace {

constexpr double kLeastPatience = 20;  // looks

// s: how long a grain may wait for a place: twice as long as it takes to fall through the container, so that
// the one before it has had time to leave the box; and at least some looks.
double patience(const Scene& scene, double look) {
    const double gravity = scene.gravity.norm();
    const double height = scene.container.height - scene.container.base();
    const double fall = gravity > 0 ? std::sqrt(2 * height / gravity) : 0;
    return std::max(2 * fall, kLeastPatience * look);
}

// Whether the vessel's room holds a part of the box. Grains then come in the room alone: a box may lie across
// the walls of a vessel.
bool reaches_into_vessel(const Scene& scene, const Feed& feed) {
    constexpr int places = 9;  // along each axis
    for (int at = 0; at < places * places * places; ++at) {
        const Vec3 share = Vec3(at % places, at / places % places, at / (places * places)) / (places - 1);
        if (scene.container.room->holds(feed.low + share.cwiseProduct(feed.high - feed.low))) return true;
    }
    return false;
}

}  // namespace

Feeder::Feeder(const Scene& scene, const Plan& plan, const Surroundings& around)
    : scene_(scene), clock_(plan.clock), around_(around), given_(scene.feeds.size(), 0) {
    const bool mesh = scene.container.shape == Container::Shape::mesh;
    for (const Feed& feed : scene.feeds) into_vessel_.push_back(mesh && reaches_into_vessel(scene, feed));
}

std::int64_t Feeder::next_look(std::int64_t step) const {
    if (given_.empty()) return std::numeric_limits<std::int64_t>::max();
    return (step / kStepsPerLook + 1) * kStepsPerLook;
}

std::vector<NewGrain> Feeder::take(std::int64_t step, const Grains& grains) {
    const double time = clock_.time(step);
    std::vector<NewGrain> more;
    for (std::size_t k = 0; k < scene_.feeds.size(); ++k) {
        const Feed& feed = scene_.feeds[k];
        const std::int64_t due = feed.due(time);
        if (given_[k] >= due) continue;
        const double largest = 0.5 * scene_.species[feed.species].diameter.largest;
        FreePlaces free(around_, around_.motion.at(step), grains, feed.low, feed.high, largest);
        if (into_vessel_[k])
            free.only_where([this](const Vec3& place) { return scene_.container.room->holds(place); });
        for (const NewGrain& other : more) free.add({other.position, other.radius});
        for (; given_[k] < due; ++given_[k]) {
            NewGrain grain = fed_grain(scene_, k, given_[k]);
            Random random(scene_.run.seed, Stream::feed_places,
                          {static_cast<std::int64_t>(k), given_[k], step});
            const auto place = free.take(grain.radius, random);
            if (!place) break;
            grain.position = *place;
            more.push_back(grain);
        }
        if (given_[k] < due) check_patience(k, time);
    }
    return more;
}

// The next grain of a feed has found no place at this time, s.
void Feeder::check_patience(std::size_t feed, double time) const {
    const Feed& from = scene_.feeds[feed];
    const double waited = time - from.from - static_cast<double>(given_[feed] + 1) / from.rate;
    if (waited <= patience(scene_, kStepsPerLook * clock_.step)) return;
    throw RunError(fmt::format(
        "{}: at {:.6g} s grain {} of \"{}\" has waited {:.3g} s for a place where nothing is: where they "
        "appear it is full; lower the 'rate', end it earlier ('until', 'count'), or enlarge the box or "
        "the container",
        scene_.where(fmt::format("feed[{}]", feed)), time, given_[feed] + 1,
        scene_.species[from.species].name, waited));
}

}  // namespace grainreel
