#include "render/cli/period_means.hpp"

#include <algorithm>

#include "engine/base/nearest_image.hpp"

namespace grainreel {
namespace {

// From `from` to `to`, the short way round a periodic container.
Vec3 way(const Vec3& from, const Vec3& to, double depth) {
    Vec3 between = to - from;
    between.x() = nearest_image(between.x(), depth);
    return between;
}

}  // namespace

PeriodMeans::PeriodMeans(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                         const Clock& clock, std::int64_t first, double depth)
    : depth_(depth) {
    for (const Shot& shot : shots) {
        std::vector<std::int64_t> of =
            averaged_steps(shot, segments.at(static_cast<std::size_t>(shot.segment)), clock);
        if (of.empty()) continue;
        span_[shot.step] = static_cast<double>(shot.step - of.front()) * clock.step;
        for (std::int64_t& step : of) step = std::max(step, first);
        moments_.want(shot.step, of);
    }
}

void PeriodMeans::keep(const Frame& frame) {
    if (moments_.wants(frame.step))
        moments_.keep(frame.step, {frame.position, frame.wall_offset, frame.floor_offset});
}

void PeriodMeans::fill(Frame& frame) {
    average(frame, moments_.of(frame.step));
    moments_.done_with(frame.step);
}

// Leaves the frame as it is when grains have come or gone.
void PeriodMeans::average(Frame& frame, const std::vector<std::int64_t>& steps) const {
    if (steps.empty()) return;
    // The first of the steps closes the span; the mean is over the others.
    const Moment now{frame.position, frame.wall_offset, frame.floor_offset};
    std::vector<Vec3> ways(frame.size(), Vec3::Zero());
    Vec3 wall = Vec3::Zero(), floor = Vec3::Zero();
    for (std::size_t k = 1; k < steps.size(); ++k) {
        const Moment* then = moments_.at(steps[k]);
        if (!then || then->position.size() != frame.size()) return;
        for (std::size_t i = 0; i < ways.size(); ++i)
            ways[i] += way(now.position[i], then->position[i], depth_);
        wall += then->wall;
        floor += then->floor;
    }
    const Moment* before = moments_.at(steps.front());
    if (!before || before->position.size() != frame.size()) return;
    const double share = 1 / static_cast<double>(steps.size() - 1);
    const double span = span_.at(frame.step);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        frame.position[i] = now.position[i] + share * ways[i];
        frame.position[i].x() = nearest_image(frame.position[i].x(), depth_);
        frame.velocity[i] = way(before->position[i], now.position[i], depth_) / span;
    }
    frame.wall_offset = share * wall;
    frame.floor_offset = share * floor;
    frame.wall_velocity = (now.wall - before->wall) / span;
    frame.floor_velocity = (now.floor - before->floor) / span;
}

}  // namespace grainreel
