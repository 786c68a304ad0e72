#include "engine/run/driver/agenda.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/files/frames/state_archive.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

State places_of(const State& frame) {
    State places = moment_of(frame);
    places.id = frame.id;
    places.position = frame.position;
    return places;
}

void KeptStates::want(std::int64_t frame, const std::vector<WantedState>& moments) {
    for (const WantedState& moment : moments) {
        Wanted& wanted = wanted_[moment.step];
        wanted.whole = wanted.whole || moment.whole;
        wanted.last = frame;
        of_frame_[frame].insert(moment.step);
    }
}

std::set<std::int64_t> KeptStates::steps() const {
    std::set<std::int64_t> steps;
    for (const auto& [step, wanted] : wanted_) steps.insert(steps.end(), step);
    return steps;
}

void KeptStates::keep(const State& frame) {
    const auto wanted = wanted_.find(frame.step);
    if (wanted == wanted_.end()) return;
    kept_[frame.step] = std::make_shared<const State>(wanted->second.whole ? frame : places_of(frame));
}

StatePtr KeptStates::at(std::int64_t step) const {
    const auto found = kept_.find(step);
    return found == kept_.end() ? nullptr : found->second;
}

void KeptStates::done_with(std::int64_t frame) {
    const auto done = of_frame_.find(frame);
    if (done == of_frame_.end()) return;
    for (const std::int64_t step : done->second)
        if (wanted_.at(step).last == frame) kept_.erase(step);
    of_frame_.erase(done);
}

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

namespace {

constexpr double most_bytes = 40e6;
constexpr double bytes_a_grain = 68 + 3 * 44;  // its numbers in one file, and three contacts in the other
constexpr int last_periods = 2, phases = 8;    // periods of the drive, and moments in each
constexpr int between = 12;

// The wanted steps, the most important ones first.
std::vector<std::int64_t> wanted_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                       const std::vector<double>& named) {
    const std::int64_t last = plan.steps;
    std::vector<std::int64_t> steps{first, last};
    for (const double time : named) steps.push_back(std::llround(time / plan.clock.step));
    if (scene.drive.present)
        for (int k = 1; k <= last_periods * phases; ++k)
            steps.push_back(plan.clock.step_at(plan.clock.cycles(last) - static_cast<double>(k) / phases));
    for (int k = 1; k < between; ++k) steps.push_back(first + (last - first) * k / between);
    return steps;
}

}  // namespace

std::set<std::int64_t> key_steps(const Scene& scene, const Plan& plan, std::int64_t first,
                                 const std::vector<double>& named) {
    std::set<std::int64_t> steps;
    const auto most = static_cast<std::size_t>(
        most_bytes / (bytes_a_grain * static_cast<double>(std::max<std::int64_t>(1, plan.capacity))));
    for (const std::int64_t step : wanted_steps(scene, plan, first, named))
        if (steps.size() < most && step >= first && step <= plan.steps) steps.insert(step);
    return steps;
}

}  // namespace grainreel
