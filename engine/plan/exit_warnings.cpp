// Warnings of grains that lie in an exit before the run begins, or come in one.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/free_space.hpp"

namespace grainreel {

namespace {

bool in_exit(const Scene& scene, const Vec3& place) {
    return std::any_of(scene.exits.begin(), scene.exits.end(),
                       [&](const ExitBox& exit) { return exit.holds(place); });
}

double smallest_radius(const Scene& scene) {
    double smallest = scene.species[0].diameter.smallest;
    for (const Species& species : scene.species) smallest = std::min(smallest, species.diameter.smallest);
    return 0.5 * smallest;
}

// Whether any place of a box may lie in an exit.
bool may_reach_exit(const Scene& scene, const Vec3& low, const Vec3& high) {
    return std::any_of(scene.exits.begin(), scene.exits.end(), [&](const ExitBox& exit) {
        return exit.outside || ((exit.low - high).maxCoeff() <= 0 && (low - exit.high).maxCoeff() <= 0);
    });
}

// The share of the packed bed that lies in exits. A bed has at least one layer. Grains of a region fall out
// of it, so of these only those that lie in an exit from the beginning are counted.
double share_in_exits(const Scene& scene) {
    const FreeSpace room(scene);
    if (!(room.volume() > 0)) return 0;
    const double filled = solid_volume(scene) / settled_solid_fraction / room.volume();
    const double top =
        std::max(room.height_of_share(std::min(1.0, filled)), room.low().z() + largest_diameter(scene));
    if (!may_reach_exit(scene, room.low(), Vec3(room.high().x(), room.high().y(), top))) return 0;
    return room.share_of(top, smallest_radius(scene),
                         [&](const Vec3& place) { return in_exit(scene, place); });
}

// The share of a feed's box that lies in exits.
double share_of_feed(const Scene& scene, const Feed& feed) {
    constexpr int places = 9;  // along each axis, in the middles of cells
    int inside = 0;
    for (int at = 0; at < places * places * places; ++at) {
        const Vec3 cell(at % places, at / places % places, at / (places * places));
        const Vec3 share = (cell + Vec3(0.5, 0.5, 0.5)) / places;
        inside += in_exit(scene, feed.low + share.cwiseProduct(feed.high - feed.low));
    }
    return inside / static_cast<double>(places * places * places);
}

std::vector<std::string> feed_warnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (std::size_t k = 0; k < scene.feeds.size(); ++k)
        if (const double share = share_of_feed(scene, scene.feeds[k]); share > 0)
            warnings.push_back(
                fmt::format("{}: {:.3g} % of the feed's box lies in an exit, and grains that come there "
                            "leave at once; unless you mean that, move one of them",
                            scene.where(fmt::format("feed[{}]", k)), 100 * share));
    return warnings;
}

}  // namespace

std::string exit_warning(const Scene& scene, double leave, std::int64_t all, bool known) {
    return fmt::format(
        "{}: {}{:.0f} of {} grains ({:.3g} %) lie in an exit when the run begins, and leave at 0 s; unless "
        "you "
        "mean that, move the exit away from them",
        scene.where("exit[0]"), known ? "" : "about ", leave, all, 100 * leave / static_cast<double>(all));
}

std::vector<std::string> exit_warnings(const Scene& scene) {
    if (scene.exits.empty()) return {};
    std::vector<std::string> warnings = feed_warnings(scene);
    const std::int64_t all = scene.grains_at_start();
    if (all == 0 || scene.start.keep_clock) return warnings;
    double leave = 0;
    if (scene.start.method == Start::Method::grains) {
        leave = static_cast<double>(
            std::count_if(scene.start.grains.begin(), scene.start.grains.end(),
                          [&](const ListedGrain& grain) { return in_exit(scene, grain.position); }));
    } else if (scene.start.packs()) {
        leave = std::round(share_in_exits(scene) * static_cast<double>(all));
    }
    if (leave >= 1)
        warnings.push_back(exit_warning(scene, leave, all, scene.start.method == Start::Method::grains));
    return warnings;
}

}  // namespace grainreel
