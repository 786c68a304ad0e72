#include "render/picture/marks/trails.hpp"
#include "render/scene/filmed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

Trails::Trails(const FilmedScene& scene)
    : species_(scene.species.size(), false),
      grains_(scene.film.shows.trails.grains),
      duration_(scene.film.shows.trails.duration),
      longest_jump_(scene.container.periodic_depth ? 0.5 * scene.container.depth
                                                   : std::numeric_limits<double>::infinity()) {
    for (const std::size_t species : scene.film.shows.trails.species) species_[species] = true;
}

bool Trails::chosen(std::int32_t id, std::int32_t species) const {
    return species_[static_cast<std::size_t>(species)] ||
           std::find(grains_.begin(), grains_.end(), id) != grains_.end();
}

void Trails::take(const Frame& frame) {
    if (!moments_.empty() && frame.time == moments_.front().time) return;
    if (!moments_.empty() && frame.time < moments_.front().time) moments_.clear();
    Moment now{frame.time, {}, {}};
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (!chosen(frame.id[i], frame.species[i])) continue;
        now.id.push_back(frame.id[i]);
        now.at.push_back(frame.position[i]);
    }
    moments_.push_front(std::move(now));
    const double oldest = frame.time - duration_ * (1 + 1e-9);
    while (moments_.back().time < oldest) moments_.pop_back();
}

std::vector<std::vector<Trails::Point>> Trails::paths() const {
    std::vector<std::vector<Point>> paths;
    if (moments_.empty()) return paths;
    const Moment& now = moments_.front();
    for (const std::int32_t id : now.id) {
        std::vector<Point> path;
        for (const Moment& moment : moments_) {
            const auto found = std::lower_bound(moment.id.begin(), moment.id.end(), id);
            if (found == moment.id.end() || *found != id) break;
            const Vec3& at = moment.at[static_cast<std::size_t>(found - moment.id.begin())];
            if (!path.empty() && std::abs(at.x() - path.back().at.x()) > longest_jump_) break;
            path.push_back({(now.time - moment.time) / duration_, at});
        }
        paths.push_back(std::move(path));
    }
    return paths;
}

}  // namespace grainreel
