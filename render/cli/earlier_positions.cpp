#include "render/cli/earlier_positions.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

void set_displacement(Frame& now, const std::vector<Vec3>& before, double depth) {
    if (before.size() != now.size()) return;
    now.displacement.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        Vec3 way = now.position[i] - before[i];
        if (depth > 0) way.x() -= depth * std::round(way.x() / depth);
        now.displacement[i] = way;
    }
}

EarlierPositions::EarlierPositions(const std::vector<Shot>& shots, std::int64_t steps_per_period,
                                   std::int64_t first, double depth)
    : period_(steps_per_period), depth_(depth) {
    for (const Shot& shot : shots) {
        const std::int64_t before = shot.step - period_;
        if (before >= first && (steps_.empty() || before > steps_.back())) steps_.push_back(before);
    }
}

void EarlierPositions::keep(const Frame& frame) {
    if (std::binary_search(steps_.begin(), steps_.end(), frame.step)) kept_[frame.step] = frame.position;
}

void EarlierPositions::fill(Frame& frame) {
    if (period_ == 0) return;
    kept_.erase(kept_.begin(), kept_.lower_bound(frame.step - period_));
    const auto before = kept_.find(frame.step - period_);
    if (before != kept_.end()) set_displacement(frame, before->second, depth_);
}

}  // namespace grainreel
