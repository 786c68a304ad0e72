#include "render/run/moments/earlier_positions.hpp"

#include "engine/base/nearest_image.hpp"

namespace grainreel {

void set_displacement(Frame& now, const std::vector<Vec3>& before, int periods, double depth) {
    if (before.size() != now.size()) return;
    now.displacement.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        Vec3 way = now.position[i] - before[i];
        way.x() = nearest_image(way.x(), depth);
        now.displacement[i] = way / periods;
    }
}

EarlierPositions::EarlierPositions(const std::vector<Shot>& shots, std::int64_t steps_per_period,
                                   const std::vector<int>& multiples, std::int64_t first, double depth)
    : period_(steps_per_period), depth_(depth) {
    for (const Shot& shot : shots) {
        std::vector<std::int64_t> before;
        for (const int periods : multiples)
            if (shot.step - periods * period_ >= first) before.push_back(shot.step - periods * period_);
        moments_.want(shot.step, before);
    }
}

void EarlierPositions::keep(const Frame& frame) {
    if (moments_.wants(frame.step)) moments_.keep(frame.step, frame.position);
}

void EarlierPositions::fill(Frame& frame, int periods) {
    if (const auto* before = moments_.at(frame.step - periods * period_))
        set_displacement(frame, *before, periods, depth_);
    moments_.done_with(frame.step);
}

}  // namespace grainreel
