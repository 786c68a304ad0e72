#include "render/cli/earlier_positions.hpp"

#include "engine/base/nearest_image.hpp"

namespace grainreel {

void set_displacement(Frame& now, const std::vector<Vec3>& before, double depth) {
    if (before.size() != now.size()) return;
    now.displacement.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        Vec3 way = now.position[i] - before[i];
        way.x() = nearest_image(way.x(), depth);
        now.displacement[i] = way;
    }
}

EarlierPositions::EarlierPositions(const std::vector<Shot>& shots, std::int64_t steps_per_period,
                                   std::int64_t first, double depth)
    : period_(steps_per_period), depth_(depth) {
    for (const Shot& shot : shots)
        if (shot.step - period_ >= first) moments_.want(shot.step, {shot.step - period_});
}

void EarlierPositions::keep(const Frame& frame) {
    if (moments_.wants(frame.step)) moments_.keep(frame.step, frame.position);
}

void EarlierPositions::fill(Frame& frame) {
    for (const std::int64_t step : moments_.of(frame.step))
        if (const auto* before = moments_.at(step)) set_displacement(frame, *before, depth_);
    moments_.done_with(frame.step);
}

}  // namespace grainreel
