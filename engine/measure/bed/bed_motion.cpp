#include "engine/measure/bed/bed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainreel {

void Flight::add(std::int64_t from, double carried) {
    if (!state_.flying && carried < kLeaves) {
        state_.flying = true;
        state_.since = from;
    } else if (state_.flying && carried > kLands) {
        state_.flying = false;
        if (from - state_.since < least_) return;
        state_.last = {state_.since, from};
        state_.any = true;
    }
}

void PeriodMultiple::add(std::int64_t number, double height) {
    if (number != next_) heights_.clear();
    if (heights_.empty() && number % kPhases != 0)
        return;  // heights are stored from the first whole period on
    next_ = number + 1;
    heights_.push_back(height);
    if (next_ % kPhases == 0) end_period();
}

void PeriodMultiple::end_period() {
    constexpr std::size_t wanted = kPhases * (kWindow + kMost);
    while (heights_.size() > wanted) heights_.pop_front();
    if (heights_.size() < wanted) return;
    difference_ = difference_to(1);
    const int now = multiple_now();
    confirmed_ = now == other_ ? confirmed_ + 1 : 1;
    other_ = now;
    if (confirmed_ >= (value_ == 1 ? kConfirm : kChange)) value_ = now;
}

double PeriodMultiple::difference_to(int periods_before) const {
    double sum = 0;
    for (std::size_t i = kPhases * kMost; i < heights_.size(); ++i)
        sum += std::pow(heights_[i] - heights_[i - static_cast<std::size_t>(periods_before * kPhases)], 2);
    return std::sqrt(sum / (kPhases * kWindow));
}

// Finds the number of periods after which the bed repeats itself. A multiple counts if it leaves at most half
// of the difference. A drift grows with the number of periods and noise stays as it is, so neither makes a
// multiple. A larger multiple is looked for only while more than a quarter of the difference is left.
int PeriodMultiple::multiple_now() const {
    int multiple = 1;
    double left = difference_;
    const double settled = std::max(least_, 0.25 * difference_);
    for (int periods = 2; periods <= kMost && left > settled; ++periods) {
        const double difference = difference_to(periods);
        if (difference > 0.5 * left) continue;
        multiple = periods;
        left = difference;
    }
    return multiple;
}

void PeriodMultiple::save(std::ostream& out) const {
    const Writing each{out};
    each(std::vector<double>(heights_.begin(), heights_.end()));
    each(next_), each(value_), each(other_), each(confirmed_), each(difference_);
}

void PeriodMultiple::load(Bytes& in) {
    const Reading each{in};
    std::vector<double> heights;
    each(heights), each(next_), each(value_), each(other_), each(confirmed_), each(difference_);
    heights_.assign(heights.begin(), heights.end());
    const auto is_multiple = [](int periods) { return periods >= 1 && periods <= kMost; };
    if (heights_.size() >= kPhases * (kWindow + kMost + 1) || next_ < -1 || !is_multiple(value_) ||
        !is_multiple(other_) || confirmed_ < 0)
        in.fail();
}

}  // namespace grainreel
