#include "engine/questions/statistics.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/questions.hpp"

namespace grainreel {

double student_probability(double t, int freedom) {
    const double angle = math::atan2(t, std::sqrt(freedom));  // theta of 26.7.3
    const double cosine = math::cos(angle), sine = math::sin(angle);
    const bool odd = freedom % 2 == 1;
    // The series is cos + 2/3 cos^3 + ..., up to cos^(freedom - 2), or 1 + 1/2 cos^2 + ... up to the same
    // power.
    double term = odd ? cosine : 1, sum = 0;
    for (int power = odd ? 1 : 0; power <= freedom - 2; power += 2) {
        sum += term;
        term *= cosine * cosine * (power + 1) / (power + 2);
    }
    return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
}

double student_t(double probability, int freedom) {
    GRAINREEL_CHECK(probability > 0 && probability < 1 && freedom >= 1);
    double low = 0, high = 1;
    while (student_probability(high, freedom) < probability) high *= 2;
    while (high - low > 1e-13 * high) {
        const double middle = (low + high) / 2;
        (student_probability(middle, freedom) < probability ? low : high) = middle;
    }
    return high;
}

MeanInterval mean_interval(const std::vector<double>& values, double probability) {
    MeanInterval result{0, 0, kUnknown};
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        ++result.count;
        result.mean += value;
    }
    const auto count = static_cast<double>(result.count);
    result.mean = result.count > 0 ? result.mean / count : kUnknown;
    if (result.count < 2) return result;
    double squares = 0;
    for (const double value : values)
        if (std::isfinite(value)) squares += (value - result.mean) * (value - result.mean);
    const double deviation = std::sqrt(squares / (count - 1));
    result.half = student_t(probability, static_cast<int>(result.count) - 1) * deviation / std::sqrt(count);
    return result;
}

void Histogram::add(const Snapshot& s) {
    if (s.frame.size() == 0 && moments_ == 0) throw UserError("there are no grains at this moment");
    const int number = column_called(s, name_);
    const GrainColumn& column = grain_columns()[number];
    if (column.is_species) throw UserError("species have no order; ask for a quantity, as in \"speed\"");
    dimension_ = column.dimension;
    if (species_.empty())
        for (const Species& species : s.scene.species) species_.push_back(species.name);
    values_.resize(species_.size());
    ++moments_;
    const std::vector<double> values = values_of(s, number);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        if (++count_ > kMostValues)
            throw UserError("{} moments of {} grains are too many; ask for fewer periods", moments_,
                            s.frame.size());
        values_[s.frame.species[i]].push_back(values[i]);
    }
}

Answer Histogram::answer(std::size_t bins) const {
    if (count_ == 0) throw UserError("no grain has a '{}' at this moment", name_);
    double least = 0, most = 0;
    bool any = false;
    for (const std::vector<double>& all : values_)
        for (const double value : all) {
            least = any ? std::min(least, value) : value;
            most = any ? std::max(most, value) : value;
            any = true;
        }
    const double width = (most - least) / static_cast<double>(bins);
    std::vector<std::vector<std::int64_t>> counts(bins, std::vector<std::int64_t>(species_.size(), 0));
    for (std::size_t k = 0; k < values_.size(); ++k)
        for (const double value : values_[k]) {
            const double place = width > 0 ? (value - least) / width : 0;
            ++counts[std::min(bins - 1, static_cast<std::size_t>(place))][k];
        }
    AnswerTable table{"histogram",
                      fmt::format("How many grains have which {}", name_),
                      {{name_ + "_from", dimension_, ""}, {name_ + "_to", dimension_, ""}},
                      {}};
    if (moments_ > 1) table.title += fmt::format(", mean over {} moments", moments_);
    for (const std::string& species : species_)
        table.columns.push_back({"grains_" + species, Dimension::number, ""});
    for (std::size_t k = 0; k < bins; ++k) {
        std::vector<AnswerCell> row = {least + static_cast<double>(k) * width,
                                       k + 1 == bins ? most : least + static_cast<double>(k + 1) * width};
        for (const std::int64_t count : counts[k]) {
            if (moments_ == 1)
                row.emplace_back(count);
            else
                row.emplace_back(static_cast<double>(count) / static_cast<double>(moments_));
        }
        table.rows.push_back(std::move(row));
    }
    return {{std::move(table)}, {}};
}

Answer histogram_answer(const Snapshot& s, const std::string& column, std::size_t bins) {
    Histogram histogram(column);
    histogram.add(s);
    return histogram.answer(bins);
}

}  // namespace grainreel
