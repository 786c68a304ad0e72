#include "render/run/moments/period_means.hpp"

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
                         const Clock& clock, const std::vector<int>& multiples, std::int64_t first,
                         double depth)
    : segments_(segments), clock_(clock), first_(first), depth_(depth) {
    for (const Shot& shot : shots) {
        std::set<std::int64_t> wanted;
        for (const int periods : multiples)
            for (const std::int64_t step : steps_of(shot, periods)) wanted.insert(std::max(step, first_));
        if (wanted.empty()) continue;
        segment_[shot.step] = shot.segment;
        moments_.want(shot.step, {wanted.begin(), wanted.end()});
    }
}

std::vector<std::int64_t> PeriodMeans::steps_of(const Shot& shot, int periods) const {
    return averaged_steps(shot, segments_.at(static_cast<std::size_t>(shot.segment)), clock_, periods);
}

void PeriodMeans::keep(const Frame& frame) {
    if (moments_.wants(frame.step)) moments_.keep(frame.step, {frame.position, frame.bodies});
}

void PeriodMeans::fill(Frame& frame, int periods) {
    const auto segment = segment_.find(frame.step);
    if (segment == segment_.end()) return;
    average(frame, steps_of({frame.step, segment->second}, periods));
    leave_out(frame.step);
}

void PeriodMeans::leave_out(std::int64_t step) {
    segment_.erase(step);
    moments_.done_with(step);
}

// Leaves the frame as it is when grains have come or gone.
void PeriodMeans::average(Frame& frame, const std::vector<std::int64_t>& steps) const {
    // The first of the steps closes the span; the mean is over the others.
    const Moment now{frame.position, frame.bodies};
    std::vector<Vec3> ways(frame.size(), Vec3::Zero());
    std::vector<Vec3> places(now.bodies.size(), Vec3::Zero());
    for (std::size_t k = 1; k < steps.size(); ++k) {
        const Moment* then = moments_.at(std::max(steps[k], first_));
        if (!then || then->position.size() != frame.size()) return;
        for (std::size_t i = 0; i < ways.size(); ++i)
            ways[i] += way(now.position[i], then->position[i], depth_);
        for (std::size_t b = 0; b < places.size(); ++b) places[b] += then->bodies[b].place;
    }
    const Moment* before = moments_.at(std::max(steps.front(), first_));
    if (!before || before->position.size() != frame.size()) return;
    const double span = static_cast<double>(frame.step - steps.front()) * clock_.step;
    const double share = 1 / static_cast<double>(steps.size() - 1);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        frame.position[i] = now.position[i] + share * ways[i];
        frame.position[i].x() = nearest_image(frame.position[i].x(), depth_);
        frame.velocity[i] = way(before->position[i], now.position[i], depth_) / span;
    }
    for (std::size_t b = 0; b < places.size(); ++b) {
        frame.bodies[b].place = share * places[b];
        frame.bodies[b].velocity = (now.bodies[b].place - before->bodies[b].place) / span;
    }
}

}  // namespace grainreel
