#include "engine/base/clock.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/numbers.hpp"

namespace grainreel {

double PeriodStretch::cycles_after(double time) const {
    if (!changes()) return time / period;
    const double u = std::clamp(time / length, 0.0, 1.0);
    return length * (u / period + (1 / period_after - 1 / period) * smooth_step::area(u));
}

double PeriodStretch::into_period(double whole, double part) const {
    const double into = std::fmod(whole, period) + part;  // fmod is exact
    return into - period * std::floor(into / period);
}

double PeriodStretch::turns_after(double whole, double part) const {
    if (!changes()) return into_period(whole, part) / period;
    const double gone = cycles_after(whole + part);
    return gone - std::floor(gone);
}

double PeriodStretch::time_after(double wanted) const {
    if (!changes()) return wanted * period;
    // Frequencies are positive, so the count of periods only grows. Halving finds the time to the last bit.
    double low = 0, high = length;
    for (int halving = 0; halving < 64; ++halving) {
        const double middle = 0.5 * (low + high);
        (cycles_after(middle) < wanted ? low : high) = middle;
    }
    return high;
}

double length_of_change(double cycles, double period, double period_after) {
    return 2 * cycles / (1 / period + 1 / period_after);  // the mean of s is 1/2
}

std::size_t PeriodTable::index_at(double time) const {
    const auto after = std::upper_bound(stretches_.begin() + 1, stretches_.end(), time,
                                        [](double t, const PeriodStretch& s) { return t < s.start; });
    return static_cast<std::size_t>(after - stretches_.begin()) - 1;
}

std::size_t PeriodTable::index_at_cycles(double cycles) const {
    const auto after = std::upper_bound(stretches_.begin() + 1, stretches_.end(), cycles,
                                        [](double c, const PeriodStretch& s) { return c < s.cycles; });
    return static_cast<std::size_t>(after - stretches_.begin()) - 1;
}

double PeriodTable::cycles(double time) const {
    const PeriodStretch& in = stretches_[index_at(time)];
    return in.cycles + in.cycles_after(time - in.start);
}

double PeriodTable::time(double cycles) const {
    const PeriodStretch& in = stretches_[index_at_cycles(cycles)];
    return in.start + in.time_after(cycles - in.cycles);
}

}  // namespace grainreel
