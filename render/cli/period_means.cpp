#include "render/cli/period_means.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

// From `from` to `to`, the short way round a periodic container.
Vec3 way(const Vec3& from, const Vec3& to, double depth) {
    Vec3 between = to - from;
    if (depth > 0) between.x() -= depth * std::round(between.x() / depth);
    return between;
}

}  // namespace

PeriodMeans::PeriodMeans(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                         const Clock& clock, std::int64_t first, double depth)
    : first_(first), depth_(depth), step_time_(clock.step) {
    for (const Shot& shot : shots) {
        std::vector<std::int64_t> of =
            averaged_steps(shot, segments.at(static_cast<std::size_t>(shot.segment)), clock);
        if (of.empty()) continue;
        for (const std::int64_t step : of) steps_.push_back(std::max(step, first));
        wanted_[shot.step] = std::move(of);
    }
    std::sort(steps_.begin(), steps_.end());
    steps_.erase(std::unique(steps_.begin(), steps_.end()), steps_.end());
}

void PeriodMeans::keep(const Frame& frame) {
    if (std::binary_search(steps_.begin(), steps_.end(), frame.step))
        kept_[frame.step] = {frame.position, frame.wall_offset, frame.floor_offset};
}

const PeriodMeans::Moment* PeriodMeans::at(std::int64_t step) const {
    const auto found = kept_.find(std::max(step, first_));
    return found == kept_.end() ? nullptr : &found->second;
}

void PeriodMeans::fill(Frame& frame) {
    const auto wanted = wanted_.find(frame.step);
    if (wanted == wanted_.end()) return;
    const std::vector<std::int64_t> steps = std::move(wanted->second);
    wanted_.erase(wanted_.begin(), std::next(wanted));

    // The first of the steps closes the span; the mean is over the others.
    const Moment now{frame.position, frame.wall_offset, frame.floor_offset};
    std::vector<Vec3> ways(frame.size(), Vec3::Zero());
    Vec3 wall = Vec3::Zero(), floor = Vec3::Zero();
    for (std::size_t k = 1; k < steps.size(); ++k) {
        const Moment* then = at(steps[k]);
        if (!then || then->position.size() != frame.size()) return;
        for (std::size_t i = 0; i < ways.size(); ++i)
            ways[i] += way(now.position[i], then->position[i], depth_);
        wall += then->wall;
        floor += then->floor;
    }
    const Moment* before = at(steps.front());
    if (!before || before->position.size() != frame.size()) return;
    const double share = 1 / static_cast<double>(steps.size() - 1);
    const double span = static_cast<double>(frame.step - steps.front()) * step_time_;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        frame.position[i] = now.position[i] + share * ways[i];
        if (depth_ > 0) frame.position[i].x() -= depth_ * std::round(frame.position[i].x() / depth_);
        frame.velocity[i] = way(before->position[i], now.position[i], depth_) / span;
    }
    frame.wall_offset = share * wall;
    frame.floor_offset = share * floor;
    frame.wall_velocity = (now.wall - before->wall) / span;
    frame.floor_velocity = (now.floor - before->floor) / span;

    std::int64_t earliest = frame.step;
    for (const auto& [step, of] : wanted_) earliest = std::min(earliest, of.front());
    kept_.erase(kept_.begin(), kept_.lower_bound(std::max(earliest, first_)));
}

}  // namespace grainreel
