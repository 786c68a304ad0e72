#include "render/run/moments/agenda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

}  // namespace

std::int64_t Rhythm::next(std::int64_t step, const Clock& clock) const {
    if (periods > 0) {
        // A step back, lest rounding skips one.
        double count = std::max(0.0, std::floor(clock.cycles(step) / periods) - 1);
        while (clock.step_at(count * periods) < step) ++count;
        return clock.step_at(count * periods);
    }
    if (steps <= 0) return never;
    double count = std::floor(static_cast<double>(step) / steps);
    while (std::llround(count * steps) < step) ++count;
    return std::llround(count * steps);
}

Agenda::Agenda(std::vector<Shot> shots, const Rhythm& trajectory, const Rhythm& measures, std::int64_t first,
               std::int64_t last, std::set<std::int64_t> moments, const Rhythm& strobe, const Clock& clock)
    : shots_(std::move(shots)),
      moments_(std::move(moments)),
      trajectory_(trajectory),
      measures_(measures),
      strobe_(strobe),
      clock_(clock),
      first_(first),
      last_(last),
      at_(first) {
    std::erase_if(shots_, [&](const Shot& shot) { return shot.step < first || shot.step > last; });
}

std::optional<Stop> Agenda::next() {
    if (at_ > last_) return std::nullopt;
    const std::int64_t shot = shot_ < shots_.size() ? shots_[shot_].step : never;
    const std::int64_t trajectory = trajectory_.next(at_, clock_);
    const std::int64_t measures = at_ == first_ ? first_ : measures_.next(at_, clock_);
    const std::int64_t strobe = strobe_.next(at_, clock_);
    const std::int64_t moment = moments_.empty() ? never : *moments_.begin();

    Stop stop;
    stop.step = std::min({shot, trajectory, measures, moment, strobe, last_});
    stop.moment = moment == stop.step;
    if (stop.moment) moments_.erase(moments_.begin());
    while (shot_ < shots_.size() && shots_[shot_].step == stop.step)
        stop.segments.push_back(shots_[shot_++].segment);
    stop.trajectory = trajectory == stop.step;
    stop.strobe = strobe == stop.step;
    stop.measures = measures == stop.step || stop.step == last_;
    at_ = stop.step + 1;
    return stop;
}

}  // namespace grainreel
