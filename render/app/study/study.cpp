#include "render/app/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/numbers.hpp"
#include "engine/base/typed_time.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {
namespace {

// Whether `asked` is true for the seeds of the study or of one of its variants.
template <typename Asked>
bool any_seeds(const Study& study, const Asked& asked) {
    if (asked(study.seeds)) return true;
    if (!study.has_variants()) return false;
    const std::vector<Variation::Value>& variants = study.variations.front().values;
    return std::any_of(variants.begin(), variants.end(),
                       [&](const Variation::Value& variant) { return asked(variant.seeds); });
}

// The time at which the straight line from row i - 1 to row i reaches the threshold.
double time_between(double threshold, const std::vector<double>& times, const std::vector<double>& values,
                    std::size_t i) {
    const double share = (threshold - values[i - 1]) / (values[i] - values[i - 1]);
    return times[i - 1] + share * (times[i] - times[i - 1]);
}

struct TimedRows {
    std::vector<double> times, values;
};

// The rows within the window. A row at an end of the window counts although its time is rounded.
TimedRows rows_within(const Reduction& how, const std::vector<double>& times,
                      const std::vector<double>& values) {
    constexpr double step = 0;  // not known here
    TimedRows rows;
    for (const std::size_t i : typed_span(times, step, how.from, how.to)) {
        rows.times.push_back(times[i]);
        rows.values.push_back(values[i]);
    }
    return rows;
}

TimedRows finite_rows(const TimedRows& all) {
    TimedRows rows;
    for (std::size_t i = 0; i < all.times.size(); ++i) {
        if (!std::isfinite(all.values[i])) continue;
        rows.times.push_back(all.times[i]);
        rows.values.push_back(all.values[i]);
    }
    return rows;
}

}  // namespace

Assignments Variation::assignments(std::size_t number) const {
    const Value& value = values[number];
    if (key == variant_axis) return value.sets;
    return {{key + "=" + value.toml, value.place}};
}

void Study::try_value(double x) {
    Variation& variation = variations.front();
    const std::string& unit = search->written_unit;
    const std::string number = fmt::format("{:.12g}", x);
    Variation::Value value;
    value.words = unit.empty() ? number : number + " " + unit;
    value.toml = unit.empty() ? number : "\"" + value.words + "\"";
    value.place = variation.place;
    value.number = x;
    const auto after = std::find_if(variation.values.begin(), variation.values.end(),
                                    [&](const Variation::Value& other) { return other.number > x; });
    variation.values.insert(after, std::move(value));
}

const Seeds& Study::seeds_of(const std::vector<std::size_t>& at) const {
    if (!has_variants()) return seeds;
    const Variation::Value& variant = variations.front().values[at.front()];
    return variant.seeds.empty() ? seeds : variant.seeds;
}

std::size_t Study::seed_count(const std::vector<std::size_t>& at) const {
    return std::max<std::size_t>(1, seeds_of(at).size());
}

bool Study::has_seeds() const {
    return any_seeds(*this, [](const Seeds& some) { return !some.empty(); });
}

bool Study::has_intervals() const {
    return any_seeds(*this, [](const Seeds& some) { return some.size() > 1; });
}

ShownUnit unit_of_x(const Study& study, const StudyChart& chart) {
    const Variation& axis = study.variations[chart.x];
    return shown_unit(chart.x_label.empty() ? axis.shown : chart.x_label, axis.unit);
}

ShownUnit unit_of_y(const Study& study, const StudyChart& chart) {
    const StudyMeasure& measure = study.measures[chart.y];
    return shown_unit(chart.y_label.empty() ? measure.label : chart.y_label, measure.unit);
}

double shown_x(const Study& study, const StudyChart& chart, double number) {
    return chart.x_per_words.empty() ? number * unit_of_x(study, chart).factor : number / chart.x_per;
}

bool Study::joins_by(SeedAverage average) const {
    return std::any_of(measures.begin(), measures.end(),
                       [&](const StudyMeasure& measure) { return measure.average == average; });
}

double mean_of_values(const std::vector<double>& values) {
    if (values.empty()) return kUnknown;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of_values(const std::vector<double>& values) {
    if (values.size() < 2) return kUnknown;
    const double mean = mean_of_values(values);
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double slope_of(const std::vector<double>& times, const std::vector<double>& values) {
    const double mean_time = mean_of_values(times), mean_value = mean_of_values(values);
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        products += (times[i] - mean_time) * (values[i] - mean_value);
        squares += (times[i] - mean_time) * (times[i] - mean_time);
    }
    return squares > 0 ? products / squares : kUnknown;
}

double first_passage(double threshold, const std::vector<double>& times, const std::vector<double>& values) {
    if (values.empty()) return kUnknown;
    const bool begins_above = values[0] > threshold;
    if (values[0] == threshold) return times[0];
    for (std::size_t i = 1; i < values.size(); ++i) {
        const bool reached = begins_above ? values[i] <= threshold : values[i] >= threshold;
        if (reached) return time_between(threshold, times, values, i);
    }
    return kUnknown;
}

double last_crossing(double threshold, const std::vector<double>& times, const std::vector<double>& values) {
    for (std::size_t i = values.size(); i-- > 1;)
        if ((values[i] >= threshold) != (values[i - 1] >= threshold))
            return time_between(threshold, times, values, i);
    return kUnknown;
}

double reduce(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values) {
    const TimedRows all = rows_within(how, times, values);
    const TimedRows rows = finite_rows(all);
    switch (how.kind) {
        case Reduction::Kind::mean:
            return mean_of_values(rows.values);
        case Reduction::Kind::slope:
            return slope_of(rows.times, rows.values);
        case Reduction::Kind::crossing:
            return last_crossing(how.threshold, rows.times, rows.values);
        case Reduction::Kind::first_passage:
            return first_passage(how.threshold, rows.times, rows.values);
        case Reduction::Kind::share:
            if (rows.values.empty()) return kUnknown;
            return std::isfinite(first_passage(how.threshold, rows.times, rows.values)) ? 1 : 0;
        case Reduction::Kind::max:
            return rows.values.empty() ? kUnknown : *std::max_element(rows.values.begin(), rows.values.end());
        case Reduction::Kind::min:
            return rows.values.empty() ? kUnknown : *std::min_element(rows.values.begin(), rows.values.end());
        case Reduction::Kind::deviation:
            return deviation_of_values(rows.values);
        case Reduction::Kind::end:
            break;
    }
    return all.values.empty() ? kUnknown : all.values.back();
}

double last_time(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values) {
    const TimedRows rows = finite_rows(rows_within(how, times, values));
    return rows.times.empty() ? kUnknown : rows.times.back();
}

}  // namespace grainreel
