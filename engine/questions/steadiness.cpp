#include "engine/questions/steadiness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/run/stored/stored_run.hpp"

namespace grainreel {

namespace {

struct Batch {
    double from = 0, time = 0, value = 0;  // s: time of the first row, mean time; mean value
};

// Joins the batches [begin, end) into one.
Batch joined(const std::vector<Batch>& parts, std::size_t begin, std::size_t end) {
    Batch all;
    all.from = parts[begin].from;
    for (std::size_t i = begin; i < end; ++i) all.time += parts[i].time, all.value += parts[i].value;
    const auto count = static_cast<double>(end - begin);
    return {all.from, all.time / count, all.value / count};
}

std::vector<Batch> finite_rows(const std::vector<double>& times, const std::vector<double>& values) {
    std::vector<Batch> rows;
    for (std::size_t i = 0; i < times.size(); ++i)
        if (std::isfinite(values[i])) rows.push_back({times[i], times[i], values[i]});
    return rows;
}

// Batches of rows: those of each whole period, or kRowsWithoutDrive rows where `period` is 0. Rows left over
// at the end belong to no batch.
std::vector<Batch> batches_of(const std::vector<Batch>& rows, double period) {
    constexpr double rounding = 1e-6;  // tolerance as a share of a period, because times are rounded
    std::vector<Batch> batches;
    for (std::size_t begin = 0; begin < rows.size();) {
        std::size_t end = begin + kRowsWithoutDrive;
        if (period > 0) {
            const double number = std::floor(rows[begin].time / period + rounding);
            for (end = begin; end < rows.size() && rows[end].time < (number + 1 - rounding) * period;) ++end;
            if (end == rows.size()) break;  // this period may lack rows
        }
        if (end > rows.size()) break;
        batches.push_back(joined(rows, begin, end));
        begin = end;
    }
    return batches;
}

// At most kMostBatches batches of equal length. Rows left over are dropped at the front, nearest to the
// transient.
std::vector<Batch> long_batches(const std::vector<Batch>& rest) {
    const std::size_t count = std::min(kMostBatches, rest.size());
    std::vector<Batch> all;
    if (count == 0) return all;
    const std::size_t each = rest.size() / count;
    for (std::size_t begin = rest.size() - count * each; begin < rest.size(); begin += each)
        all.push_back(joined(rest, begin, begin + each));
    return all;
}

double sen_slope(const std::vector<Batch>& all) {
    std::vector<double> slopes;
    for (std::size_t j = 1; j < all.size(); ++j)
        for (std::size_t i = 0; i < j; ++i)
            slopes.push_back((all[j].value - all[i].value) / (all[j].time - all[i].time));
    std::sort(slopes.begin(), slopes.end());
    const std::size_t middle = slopes.size() / 2;
    return slopes.size() % 2 == 1 ? slopes[middle] : 0.5 * (slopes[middle - 1] + slopes[middle]);
}

std::vector<double> values_of(const std::vector<Batch>& all) {
    std::vector<double> values;
    for (const Batch& one : all) values.push_back(one.value);
    return values;
}

// Takes the mean from the values. Values that are equal but for rounding become 0.
std::vector<double> without_mean(std::vector<double> values) {
    const double first = values.front();
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::abs(first);
    double mean = 0;
    for (double& value : values) {
        value = std::abs(value - first) > rounding ? value - first : 0;
        mean += value / static_cast<double>(values.size());
    }
    for (double& value : values) value -= mean;
    return values;
}

// Takes the straight line of least squares from the values.
std::vector<double> without_line(const std::vector<double>& values) {
    std::vector<double> rest = without_mean(values);
    const double middle = 0.5 * static_cast<double>(rest.size() - 1);
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const double x = static_cast<double>(i) - middle;
        products += x * rest[i], squares += x * x;
    }
    for (std::size_t i = 0; i < rest.size(); ++i)
        rest[i] -= products / squares * (static_cast<double>(i) - middle);
    return rest;
}

// Lag-1 correlation of values whose mean is 0; 0 if all of them are.
double lag_1_of(const std::vector<double>& values) {
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        squares += values[i] * values[i];
        if (i > 0) products += values[i] * values[i - 1];
    }
    return squares > 0 ? products / squares : 0;
}

// Lag-1 correlation of at least three values, without their trend and without the bias that this brings.
double correlation_of(const std::vector<double>& values) {
    const double r = lag_1_of(without_line(values));
    return r + (2 + 4 * r) / static_cast<double>(values.size());
}

// The factor by which the error of the mean of k values with this lag-1 correlation is larger than without
// one. The correlation that is measured with their mean is too small by (1 + 3 r) / k.
double widening(const std::vector<double>& means) {
    const double r = lag_1_of(without_mean(means));
    const double correlation = std::clamp(r + (1 + 3 * r) / static_cast<double>(means.size()), 0.0, 0.9);
    return std::sqrt((1 + correlation) / (1 - correlation));
}

// The largest lag-1 correlation of k independent values that is left to chance, one-sided at kSignificance.
double chance_of_correlation(std::size_t k) {
    return 1.645 / std::sqrt(static_cast<double>(k));
}

// The rows whose mean is asked for: all behind the transient, or with a drive the means of its periods.
std::vector<double> rows_behind(const std::vector<Batch>& rows, const std::vector<Batch>& rest,
                                double period) {
    if (period > 0) return values_of(rest);
    std::vector<double> values;
    for (const Batch& row : rows)
        if (row.time >= rest.front().from && values.size() < rest.size() * kRowsWithoutDrive)
            values.push_back(row.value);
    return values;
}

const char* word_of(const Steadiness& of) {
    switch (of.verdict) {
        case Steadiness::Verdict::steady:
            return "steady";
        case Steadiness::Verdict::drifts:
            return "drifts";
        case Steadiness::Verdict::too_short:
            break;
    }
    return "too short to tell";
}

std::string why(const Steadiness& of, bool driven) {
    const std::string unit = driven ? "periods" : fmt::format("batches of {} rows", kRowsWithoutDrive);
    if (of.verdict != Steadiness::Verdict::too_short)
        return fmt::format("the first {} of {} {} are left out as transient", of.dropped, of.batches, unit);
    if (of.batches < kLeastBatches)
        return fmt::format("there are {} {}, and {} are the least that tell anything; run longer", of.batches,
                           unit, kLeastBatches);
    if (of.dropped >= of.batches)
        return "the mean is still on its way in the second half, so the transient is not over; run longer";
    if (of.batches - of.dropped < kLeastBatches)
        return fmt::format("behind the transient there are {} {}, and {} are the least; run longer",
                           of.batches - of.dropped, unit, kLeastBatches);
    if (of.independent < kLeastIndependent)
        return fmt::format(
            "the rows behind the transient hang together: they are worth {:.0f} independent "
            "values, and {:g} are the least; run longer",
            std::floor(of.independent), kLeastIndependent);
    return fmt::format(
        "the means behind the transient hang together, with a lag-1 correlation of {:.2f}; "
        "run longer",
        of.correlation);
}

}  // namespace

std::size_t mser_truncation(const std::vector<double>& means) {
    const std::size_t n = means.size();
    double sum = 0, squares = 0, least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    const double offset = n > 0 ? means.back() : 0;  // subtracted, so that squares do not cancel
    constexpr std::size_t least_rest = 5;            // with one or two values the error is 0 by chance
    for (std::size_t d = n; d-- > 0;) {
        const double value = means[d] - offset;
        sum += value, squares += value * value;
        const auto count = static_cast<double>(n - d);
        const double error = std::max(0.0, squares - sum * sum / count) / (count * count);
        if (n - d >= least_rest && error <= least) least = error, best = d;
    }
    return 2 * best > n ? n : best;
}

double independent_values(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    if (values.size() < 3) return n;
    const double r = std::clamp(correlation_of(values), -0.99, 0.999999);
    return n * (1 - r) / (1 + r);
}

MannKendall mann_kendall(const std::vector<double>& values) {
    MannKendall test;
    const auto n = static_cast<double>(values.size());
    if (values.size() < 2) return test;
    std::map<double, double> ties;
    for (std::size_t j = 0; j < values.size(); ++j) {
        ++ties[values[j]];
        for (std::size_t i = 0; i < j; ++i) test.s += (values[j] > values[i]) - (values[j] < values[i]);
    }
    double variance = n * (n - 1) * (2 * n + 5);
    for (const auto& [value, t] : ties) variance -= t * (t - 1) * (2 * t + 5);
    variance /= 18;
    test.tau = test.s / (0.5 * n * (n - 1));
    if (variance <= 0 || test.s == 0) return test;
    test.z = (test.s > 0 ? test.s - 1 : test.s + 1) / std::sqrt(variance);
    test.p = math::erfc(std::abs(test.z) / std::sqrt(2.0));
    return test;
}

Steadiness steadiness_of(const std::vector<double>& times, const std::vector<double>& values, double period) {
    const std::vector<Batch> rows = finite_rows(times, values), all = batches_of(rows, period);
    Steadiness of;
    of.batches = all.size();
    if (of.batches < kLeastBatches) return of;
    std::vector<double> means = values_of(all);
    of.dropped = mser_truncation(means);
    if (of.batches - of.dropped < kLeastBatches) return of;
    const std::vector<Batch> rest(all.begin() + static_cast<std::ptrdiff_t>(of.dropped), all.end());
    const std::vector<Batch> tested = long_batches(rest);
    means = values_of(tested);
    of.independent = independent_values(rows_behind(rows, rest, period));
    of.correlation = correlation_of(means);
    if (of.independent < kLeastIndependent || of.correlation > chance_of_correlation(means.size())) return of;
    const MannKendall test = mann_kendall(means);
    of.from = rest.front().from;
    of.tested = tested.size();
    of.mean = joined(rest, 0, rest.size()).value;
    of.half_width = mean_interval(means).half * widening(means);
    of.slope = sen_slope(tested);
    of.tau = test.tau, of.p = test.p;
    of.verdict = test.p < kSignificance ? Steadiness::Verdict::drifts : Steadiness::Verdict::steady;
    return of;
}

Estimate mean_estimate(const std::vector<double>& times, const std::vector<double>& values, double period) {
    const std::vector<Batch> rows = finite_rows(times, values);
    Estimate all;
    all.rows = rows.size();
    if (rows.empty()) {
        all.why = "no row has a value";
        return all;
    }
    all.value = joined(rows, 0, rows.size()).value;
    const std::vector<Batch> parts = batches_of(rows, period), tested = long_batches(parts);
    all.batches = tested.size();
    if (parts.size() < kLeastBatches) {
        all.why = fmt::format("too short: {} {}, and {} are the least", parts.size(),
                              period > 0 ? "periods" : fmt::format("batches of {} rows", kRowsWithoutDrive),
                              kLeastBatches);
        return all;
    }
    const std::vector<double> means = values_of(tested);
    all.independent = independent_values(rows_behind(rows, parts, period));
    if (all.independent < kLeastIndependent || correlation_of(means) > chance_of_correlation(means.size()))
        all.why = fmt::format("too short: the rows hang together and are worth {}",
                              counted(std::floor(all.independent), "independent value"));
    else
        all.half_width = mean_interval(means).half * widening(means);
    return all;
}

Estimate slope_estimate(const std::vector<double>& times, const std::vector<double>& values) {
    const std::vector<Batch> rows = finite_rows(times, values);
    Estimate all;
    all.rows = rows.size();
    if (rows.size() < 2) {
        all.why = "too short: a slope needs two rows";
        return all;
    }
    const Batch middle = joined(rows, 0, rows.size());
    double products = 0, squares = 0;
    for (const Batch& row : rows) {
        products += (row.time - middle.time) * (row.value - middle.value);
        squares += (row.time - middle.time) * (row.time - middle.time);
    }
    all.value = products / squares;
    const std::size_t count = std::min(kMostBatches, (rows.size() - 1) / 2);
    if (count < kLeastBatches) {
        all.why = fmt::format("too short: {} rows, and {} are the least", rows.size(), 2 * kLeastBatches + 1);
        return all;
    }
    std::vector<double> slopes;
    for (std::size_t k = 0; k < count; ++k) {
        const Batch &begin = rows[k * (rows.size() - 1) / count],
                    &end = rows[(k + 1) * (rows.size() - 1) / count];
        slopes.push_back((end.value - begin.value) / (end.time - begin.time));
    }
    all.batches = count;
    if (correlation_of(slopes) > chance_of_correlation(count))
        all.why = "too short, or no straight line: slopes of neighbouring parts hang together";
    else
        all.half_width = std::sqrt(1.2) * mean_interval(slopes).half * widening(slopes);
    return all;
}

std::shared_ptr<const MeasureTable> table_with(const StoredRun& run, const std::string& column) {
    const std::shared_ptr<const MeasureTable> table = run.measures();
    if (table == nullptr && run.kind() == StoredRun::Kind::foreign)
        throw UserError(
            "{}: is of another program, of which there is no measures.csv; --where \"radius > 0\" "
            "--over-time "
            "--mean kinetic_energy tells energies over time, and the page of `report` draws kinetic_J",
            run.path().string());
    if (table == nullptr)
        throw UserError("{}: has no measures.csv with rows; ask a run's folder", run.path().string());
    const std::vector<std::string>& columns = table->columns();
    if (!table->find(column)) {
        const auto meant = nearest_name(column, columns);
        throw UserError("'{}' is no column of measures.csv; {}", column,
                        meant ? fmt::format("did you mean '{}'?", *meant)
                              : fmt::format("there are {}", fmt::join(columns, ", ")));
    }
    if (!table->find("time_s")) throw UserError("{}: has no column time_s", run.name_of("measures.csv"));
    return table;
}

double steady_period(const Scene& scene) {
    return scene.drive.present && !scene.drive.changes() ? 1 / scene.drive.frequency : 0;
}

Dimension dimension_of_column(const Scene& scene, const std::string& column) {
    for (const MeasureColumn& one : measure_columns(scene))
        if (one.name == column) return one.dimension;
    return Dimension::number;
}

Answer steady_answer(const StoredRun& run, const std::string& column) {
    const Scene& scene = run.known_scene();
    const std::shared_ptr<const MeasureTable> table = table_with(run, column);
    const double period = steady_period(scene);
    const bool driven = period > 0;
    const Steadiness of = steadiness_of(table->all("time_s"), table->all(column), period);
    const Dimension dimension = dimension_of_column(scene, column);
    const std::string unit = text_of(dimension).unit;
    const auto known = [](double value) { return std::isfinite(value) ? AnswerCell(value) : AnswerCell(); };
    AnswerTable answer{"steady",
                       fmt::format("Is {} steady?", column),
                       {{"verdict", Dimension::number, ""},
                        {"from", Dimension::time, "where the transient ends"},
                        {"mean", dimension, "from there on"},
                        {"half_width", dimension, "of the mean's interval of 95 %"},
                        {"drift", Dimension::number, "slope of Sen", "", (unit == "1" ? "" : unit) + "/s"},
                        {"tau", Dimension::number, "of Kendall: 1 rises always, -1 falls always"},
                        {"p", Dimension::number, "of a tau as large where nothing drifts"},
                        {"means", Dimension::number, "that were tested"},
                        {"independent", Dimension::number, "values that the rows are worth"}},
                       {{word_of(of), known(of.from), known(of.mean), known(of.half_width), known(of.slope),
                         known(of.tau), known(of.p), static_cast<std::int64_t>(of.tested),
                         of.independent > 0 ? AnswerCell(of.independent) : AnswerCell()}}};
    if (answer.columns[4].unit == "/s") answer.columns[4].unit = "1/s";
    return {
        {std::move(answer)},
        {why(of, driven),
         fmt::format(
             "transient: MSER over means of {} (White 1997; White, Cobb, Spratt 2000); drift: "
             "Mann-Kendall test at {:g} (Mann 1945, Kendall 1975), slope of Sen (1968); whether it is "
             "long enough: lag-1 correlation of rows and means (Law, Carson 1979)",
             driven ? "a period of the drive" : fmt::format("{} rows", kRowsWithoutDrive), kSignificance)}};
}

}  // namespace grainreel
