#include "engine/run/driver/agenda.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

namespace {

constexpr std::int64_t never = Rhythm::kNever;

}  // namespace

Agenda::Agenda(std::vector<std::int64_t> frames, const Rhythm& trajectory, const Rhythm& measures,
               std::int64_t first, std::int64_t last, std::set<std::int64_t> moments, const Clock& clock,
               const FieldTimes* fields)
    : frames_(std::move(frames)),
      moments_(std::move(moments)),
      trajectory_(trajectory),
      measures_(measures),
      clock_(clock),
      fields_(fields != nullptr ? std::optional(*fields) : std::nullopt),
      first_(first),
      last_(last),
      at_(first) {
    std::erase_if(frames_, [&](std::int64_t step) { return step < first || step > last; });
    moments_.erase(moments_.begin(), moments_.lower_bound(first));
}

std::optional<Stop> Agenda::next() {
    if (at_ > last_) return std::nullopt;
    const std::int64_t frame = frame_ < frames_.size() ? frames_[frame_] : never;
    const std::int64_t fields =
        fields_ ? fields_->next_end(std::max(at_, begins_ ? first_ + 1 : first_)) : never;
    const std::int64_t trajectory = trajectory_.next(at_, clock_);
    const bool begins = begins_ && at_ == first_;
    const std::int64_t measures = begins ? first_ : measures_.next(at_, clock_);
    const std::int64_t moment = moments_.empty() ? never : *moments_.begin();
    keys_.erase(keys_.begin(), keys_.lower_bound(at_));
    const std::int64_t key = keys_.empty() ? never : *keys_.begin();

    Stop stop;
    stop.step = std::min({frame, trajectory, measures, moment, fields, key, last_});
    stop.moment = moment == stop.step;
    if (stop.moment) moments_.erase(moments_.begin());
    stop.frame = frame == stop.step;
    while (frame_ < frames_.size() && frames_[frame_] == stop.step) ++frame_;
    stop.trajectory = trajectory == stop.step;
    stop.fields = fields == stop.step;
    stop.key = key == stop.step;
    stop.measures = measures == stop.step || stop.step == last_;
    at_ = stop.step + 1;
    return stop;
}

}  // namespace grainreel
