#include "engine/run/driver/late_means.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/measure/no_value.hpp"

namespace grainreel {
namespace {

constexpr int most_periods = 10;
constexpr double late_share = 0.1;  // of a run without a drive
constexpr double hair = 1e-3;       // of a period: rows are whole steps

}  // namespace

int LateMeans::periods() const {
    const double cycles = rows_.empty() ? 0 : clock_.cycles(step_of(rows_.back()));
    return static_cast<int>(std::clamp(std::floor(cycles + hair), 0.0, double{most_periods}));
}

bool LateMeans::is_late(const Measures& row) const {
    const std::int64_t last = step_of(rows_.back()), step = step_of(row);
    if (step == last) return true;
    if (clock_.steps_per_period > 0) return clock_.cycles(last) - clock_.cycles(step) < periods() - hair;
    return clock_.time(last - step) < late_share * duration_;
}

void LateMeans::add(const Measures& row) {
    rows_.push_back(row);
    while (!is_late(rows_.front())) rows_.pop_front();
}

Measures LateMeans::means() const {
    std::vector<double> means;
    for (std::size_t column = 0; column < rows_.back().values().size(); ++column) {
        double sum = 0, count = 0;
        for (const Measures& row : rows_)
            if (std::isfinite(row.values()[column])) sum += row.values()[column], ++count;
        means.push_back(count > 0 ? sum / count : kNoValue);
    }
    return {std::make_shared<const std::vector<std::string>>(rows_.back().names()), std::move(means)};
}

std::string LateMeans::over() const {
    if (rows_.size() < 2) return "the last row";
    if (clock_.steps_per_period == 0) return fmt::format("the last {:.3g} s", late_share * duration_);
    return periods() == 1 ? "the last period" : fmt::format("the last {} periods", periods());
}

}  // namespace grainreel
