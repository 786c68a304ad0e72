#include "render/picture/base/monotone_curve.hpp"

#include <algorithm>

#include "engine/base/error.hpp"

namespace grainreel {

MonotoneCurve::MonotoneCurve(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size(), 0.0) {
    GRAINREEL_CHECK(!times_.empty() && times_.size() == values_.size());
    const auto secant = [&](std::size_t i) {
        return (values_[i + 1] - values_[i]) / (times_[i + 1] - times_[i]);
    };
    for (std::size_t i = 1; i + 1 < times_.size(); ++i) {
        const double before = secant(i - 1), after = secant(i);
        if (before * after <= 0) continue;
        const double h0 = times_[i] - times_[i - 1], h1 = times_[i + 1] - times_[i];
        const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
        slopes_[i] = (w0 + w1) / (w0 / before + w1 / after);
    }
}

double MonotoneCurve::at(double time) const {
    if (time <= times_.front()) return values_.front();
    if (time >= times_.back()) return values_.back();
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i], s = (time - times_[i]) / h, r = 1 - s;
    return values_[i] * r * r * (1 + 2 * s) + values_[i + 1] * s * s * (3 - 2 * s) +
           h * s * r * (slopes_[i] * r - slopes_[i + 1] * s);
}

}  // namespace grainreel
