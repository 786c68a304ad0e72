// The axes of a study's chart as commands for gnuplot.
#include "render/app/study/results/drawing.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/lab/chart/gnuplot.hpp"

namespace grainreel {
namespace {

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(double value) {
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    }
    bool any() const { return low <= high; }
};

// All that is drawn along one axis; `above`: what is not larger is left out.
Span span_of(const std::vector<ChartSeries>& series, bool along_x, double above) {
    Span span;
    const auto take = [&](double value) {
        if (value > above) span.take(value);
    };
    for (const ChartSeries& each : series)
        for (const ChartPoint& point : each.points) {
            if (along_x) take(point.x);
            if (along_x) continue;
            for (const double value : {point.y.value, point.y.low, point.y.high, point.y.of_some})
                take(value);
            for (const double value : point.y.values) take(value);
        }
    return span;
}

// 1, 2 or 5 times a power of ten: the next one at or below a value, or at or above it.
double round_number(double value, bool above) {
    const double power = std::pow(10, std::floor(std::log10(value) + 1e-12));
    constexpr double rounding = 1e-9;
    double best = above ? 10 * power : power;
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (above && digit * power >= value * (1 - rounding)) return digit * power;
        if (!above && digit * power <= value * (1 + rounding)) best = digit * power;
    }
    return best;
}

std::string superscript(int number) {
    static const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string text = number < 0 ? "\u207b" : "";
    for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
    return text;
}

// Whether such a number is written with a power of ten.
bool is_far_from_one(double value) {
    return value != 0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e5);
}

std::string number_text(double value, bool with_power) {
    return with_power ? power_text(value) : fmt::format("{:.6g}", value);
}

// Marks of a logarithmic axis: 1, 2 and 5 in every decade where there are few, powers of ten where there are
// many. Those between have no words.
std::string log_axis(char axis, Span span) {
    const double low = round_number(span.low, false), high = round_number(span.high, true);
    const double decades = std::log10(high / low);
    const bool with_power = is_far_from_one(low) || is_far_from_one(high);
    std::string marks;
    for (double power = std::pow(10, std::floor(std::log10(low) + 1e-9)); power <= high * 1.000001;
         power *= 10)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * power;
            if (value < low * 0.999999 || value > high * 1.000001) continue;
            const bool named = digit == 1 || (decades < 3 && (digit == 2 || digit == 5));
            marks += fmt::format("{}{} {:.9g} {}", marks.empty() ? "" : ", ",
                                 named ? gnuplot_text(number_text(value, with_power)) : "''", value,
                                 named ? 0 : 1);
        }
    return fmt::format("set logscale {0}\nset {0}range [{1:.9g}:{2:.9g}]\nset {0}tics ({3})\n", axis, low,
                       high > low ? high : 10 * low, marks);
}

// Marks of an axis of very small or large numbers, all with one power of ten.
std::string small_numbers_axis(char axis, Span span) {
    span.take(0 < span.low && span.low < 0.3 * span.high ? 0 : span.low);
    const double most = std::max(std::abs(span.low), std::abs(span.high)), width = span.high - span.low;
    if (!is_far_from_one(most) || !(width > 0)) return "";
    constexpr double marks_aimed_at = 5;
    const double step = round_number(width / marks_aimed_at, true);
    const int power = static_cast<int>(std::floor(std::log10(most) + 1e-12));
    const int decimals = std::max(0, power - static_cast<int>(std::floor(std::log10(step) + 1e-12)));
    std::string marks;
    for (double k = std::floor(span.low / step) - 1; k <= std::ceil(span.high / step) + 1; ++k) {
        const double value = k * step, digits = value / std::pow(10, power);
        std::string words =
            k == 0 ? "0" : fmt::format("{:.{}f}\u00b710{}", digits, decimals, superscript(power));
        if (words.starts_with('-')) words = "\u2212" + words.substr(1);
        marks += fmt::format("{}{} {:.9g}", marks.empty() ? "" : ", ", gnuplot_text(words), value);
    }
    return fmt::format("set {}tics ({})\n", axis, marks);
}

}  // namespace

std::string power_text(double value) {
    const int power = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
    const double digits = value / std::pow(10, power);
    const std::string ten = "10" + superscript(power);
    return std::abs(digits - 1) < 1e-9 ? ten : fmt::format("{:.3g}\u00b7{}", digits, ten);
}

std::string axis_marks(const Study& study, const StudyChart& chart, const std::vector<ChartSeries>& series) {
    std::string text;
    for (const bool along_x : {true, false}) {
        if (along_x && !study.variations[chart.x].numeric) continue;
        const bool logarithmic = along_x ? chart.log_x : chart.log_y;
        const double below_all = -std::numeric_limits<double>::infinity();
        Span span = span_of(series, along_x, logarithmic ? 0 : below_all);
        if (const auto& range = along_x ? chart.x_range : chart.y_range)
            span.low = (*range)[0], span.high = (*range)[1];
        if (!span.any()) {
            if (logarithmic) text += fmt::format("set logscale {}\n", along_x ? 'x' : 'y');
            continue;
        }
        const char axis = along_x ? 'x' : 'y';
        text += logarithmic ? log_axis(axis, span) : small_numbers_axis(axis, span);
    }
    return text;
}

std::string range_of_one_height(const StudyMeasure& measure, const std::vector<ChartSeries>& series) {
    const Span span = span_of(series, false, -std::numeric_limits<double>::infinity());
    if (!span.any() || span.high - span.low > 1e-6 * std::abs(span.high)) return "";
    const double y = span.high;
    if (y == 0) return measure.from_zero ? "set yrange [0:1]\n" : "set yrange [-1:1]\n";
    if (measure.from_zero) return fmt::format("set yrange [0:{:.6g}]\n", 1.5 * y);
    return fmt::format("set yrange [{:.6g}:{:.6g}]\n", std::min(0.5 * y, 1.5 * y),
                       std::max(0.5 * y, 1.5 * y));
}

std::string search_marks(const Study& study, const StudyChart& chart) {
    if (!study.search || !study.search->found || chart.y != study.search->measure || chart.x != 0) return "";
    const auto& [low, estimate, high] = *study.search->found;
    const double level = study.search->wanted * unit_of_y(study, chart).factor;
    return fmt::format(
        "set object 1 rectangle from first {:.9g}, graph 0 to first {:.9g}, graph 1 fc rgb '#e4e4e4' "
        "fillstyle solid noborder behind\n"
        "set arrow 1 from graph 0, first {:.9g} to graph 1, first {:.9g} nohead dt 2 lc rgb '#606060'\n",
        shown_x(study, chart, low), shown_x(study, chart, high), level, level);
}

}  // namespace grainreel
