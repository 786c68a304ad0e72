#include "render/run/moments/agenda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

// The first step that is nearest to a multiple of `every` and not below `step` (which is not negative).
std::int64_t next_multiple(double every, std::int64_t step) {
    if (every <= 0) return never;
    double count = std::floor(static_cast<double>(step) / every);
    while (std::llround(count * every) < step) ++count;
    return std::llround(count * every);
}

}  // namespace

Agenda::Agenda(std::vector<Shot> shots, double trajectory_every, double measures_every, std::int64_t first,
               std::int64_t last, std::set<std::int64_t> moments, std::int64_t strobe_every,
               const FieldTimes* fields)
    : shots_(std::move(shots)),
      moments_(std::move(moments)),
      trajectory_every_(trajectory_every),
      measures_every_(measures_every),
      strobe_every_(static_cast<double>(strobe_every)),
      fields_(fields != nullptr ? std::optional(*fields) : std::nullopt),
      first_(first),
      last_(last),
      at_(first) {
    std::erase_if(shots_, [&](const Shot& shot) { return shot.step < first || shot.step > last; });
}

std::optional<Stop> Agenda::next() {
    if (at_ > last_) return std::nullopt;
    const std::int64_t shot = shot_ < shots_.size() ? shots_[shot_].step : never;
    const std::int64_t trajectory = next_multiple(trajectory_every_, at_);
    const std::int64_t measures = at_ == first_ ? first_ : next_multiple(measures_every_, at_);
    const std::int64_t strobe = next_multiple(strobe_every_, at_);
    const std::int64_t fields = fields_ ? fields_->next_end(std::max(at_, first_ + 1)) : never;
    const std::int64_t moment = moments_.empty() ? never : *moments_.begin();

    Stop stop;
    stop.step = std::min({shot, trajectory, measures, moment, strobe, fields, last_});
    stop.moment = moment == stop.step;
    if (stop.moment) moments_.erase(moments_.begin());
    while (shot_ < shots_.size() && shots_[shot_].step == stop.step)
        stop.segments.push_back(shots_[shot_++].segment);
    stop.trajectory = trajectory == stop.step;
    stop.fields = fields == stop.step;
    stop.strobe = strobe == stop.step;
    stop.measures = measures == stop.step || stop.step == last_;
    at_ = stop.step + 1;
    return stop;
}

}  // namespace grainreel
