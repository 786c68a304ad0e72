#include "render/film/moments/period_means.hpp"

#include <algorithm>

#include "engine/base/numbers.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {
namespace {

// From `from` to `to`, the short way round a periodic container.
Vec3 way(const Vec3& from, const Vec3& to, double depth) {
    Vec3 between = to - from;
    between.x() = nearest_image(between.x(), depth);
    return between;
}

}  // namespace

void set_mean(Frame& frame, const std::vector<FramePtr>& moments, double span, double depth) {
    const bool same_bodies = std::all_of(moments.begin(), moments.end(), [&](const FramePtr& then) {
        return then->bodies.size() == frame.bodies.size();
    });
    if (!same_bodies) return;
    const std::vector<Vec3> now = frame.position;
    std::vector<Vec3> ways(frame.size(), Vec3::Zero());
    std::vector<bool> throughout(frame.size(), true);
    std::vector<Vec3> places(frame.bodies.size(), Vec3::Zero());
    for (std::size_t k = 1; k < moments.size(); ++k) {
        const Frame& then = *moments[k];
        const std::vector<std::size_t> rows = rows_in(then, frame);
        for (std::size_t i = 0; i < ways.size(); ++i) {
            if (rows[i] == kNoRow)
                throughout[i] = false;
            else
                ways[i] += way(now[i], then.position[rows[i]], depth);
        }
        for (std::size_t b = 0; b < places.size(); ++b) places[b] += then.bodies[b].place;
    }
    const Frame& before = *moments.front();
    const double share = 1 / static_cast<double>(moments.size() - 1);
    const std::vector<std::size_t> first = rows_in(before, frame);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (!throughout[i] || first[i] == kNoRow) continue;
        frame.position[i] = now[i] + share * ways[i];
        frame.position[i].x() = nearest_image(frame.position[i].x(), depth);
        frame.velocity[i] = way(before.position[first[i]], now[i], depth) / span;
    }
    for (std::size_t b = 0; b < places.size(); ++b) {
        frame.bodies[b].velocity = (frame.bodies[b].place - before.bodies[b].place) / span;
        frame.bodies[b].place = share * places[b];
    }
}

}  // namespace grainreel
