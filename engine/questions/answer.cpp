#include "engine/questions/answer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"

namespace grainreel {

std::vector<std::int32_t> grains_in(const Answer& answer) {
    std::vector<std::int32_t> ids = answer.grains.value_or(std::vector<std::int32_t>{});
    for (const AnswerTable& table : answer.tables)
        for (std::size_t k = 0; k < table.columns.size(); ++k) {
            const std::string& name = table.columns[k].name;
            if (name != "id" && name != "first" && name != "second") continue;
            for (const auto& row : table.rows)
                if (const auto* id = std::get_if<std::int64_t>(&row[k]))
                    ids.push_back(static_cast<std::int32_t>(*id));
        }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

namespace {

// The number in a cell; NaN where there is none.
double number_in(const AnswerCell& cell) {
    if (const double* value = std::get_if<double>(&cell)) return *value;
    if (const std::int64_t* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
    return std::nan("");
}

std::size_t place_of(const AnswerTable& table, const std::string& column) {
    const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                    [&](const AnswerColumn& one) { return one.name == column; });
    GRAINREEL_CHECK(found != table.columns.end());
    return static_cast<std::size_t>(found - table.columns.begin());
}

}  // namespace

// Compares keys up to rounding: edges of bins come from products that differ in the last bits from moment
// to moment.
bool MeanAnswer::NearlyLess::operator()(const Key& one, const Key& other) const {
    constexpr double hair = 1e-9;
    for (std::size_t k = 0; k < one.size(); ++k) {
        const double x = one[k], y = other[k];
        if (std::abs(x - y) > hair * std::max({std::abs(x), std::abs(y), 1e-12})) return x < y;
    }
    return false;
}

MeanAnswer::Table& MeanAnswer::table_like(const AnswerTable& table) {
    const auto known = std::find_if(tables_.begin(), tables_.end(),
                                    [&](const Table& one) { return one.form.name == table.name; });
    if (known != tables_.end()) return *known;
    Table& fresh = tables_.emplace_back(Table{table, {}, {}});
    fresh.form.rows.clear();
    if (!table.has_mean) fresh.form.columns.push_back({"time", Dimension::time, "of the moment"});
    return fresh;
}

void MeanAnswer::add(const Answer& answer, double time) {
    ++moments_;
    for (const AnswerTable& table : answer.tables) {
        if (table.has_mean)
            for (const std::vector<AnswerCell>& row : table.rows) add_row(table_like(table), row);
        else if (!table.most_of.empty())
            add_list(table_like(table).form, table, time);
    }
}

MeanAnswer::Key MeanAnswer::key_of(Table& table, const std::vector<AnswerCell>& row) {
    Key key;
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (table.form.columns[k].weight != AnswerColumn::kKey) continue;
        const auto* words = std::get_if<std::string>(&row[k]);
        if (words == nullptr) {
            key.push_back(number_in(row[k]));
            continue;
        }
        const auto known = std::find(table.words.begin(), table.words.end(), *words);
        key.push_back(static_cast<double>(known - table.words.begin()));
        if (known == table.words.end()) table.words.push_back(*words);
    }
    return key;
}

void MeanAnswer::add_row(Table& table, const std::vector<AnswerCell>& row) const {
    const std::vector<AnswerColumn>& columns = table.form.columns;
    Sums& sums = table.rows[key_of(table, row)];
    if (sums.keys.empty()) sums.keys = row;
    for (std::vector<double>* numbers : {&sums.sum, &sums.weight, &sums.values})
        numbers->resize(columns.size(), 0);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const std::string& by = columns[k].weight;
        const double value = number_in(row[k]);
        if (by == AnswerColumn::kKey || !std::isfinite(value)) continue;
        const bool weighed = !by.empty() && by != AnswerColumn::kThere;
        const double weight = weighed ? number_in(row[place_of(table.form, by)]) : 1;
        sums.sum[k] += weight * value;
        sums.weight[k] += weight;
        ++sums.values[k];
    }
}

void MeanAnswer::add_list(AnswerTable& all, const AnswerTable& one, double time) const {
    for (std::vector<AnswerCell> row : one.rows) {
        row.emplace_back(time);
        all.rows.push_back(std::move(row));
    }
    const std::size_t by = place_of(all, all.most_of);
    std::stable_sort(all.rows.begin(), all.rows.end(),
                     [by](const auto& a, const auto& b) { return number_in(a[by]) > number_in(b[by]); });
    all.rows.resize(std::min(all.rows.size(), most_));
}

AnswerTable MeanAnswer::mean_of(const Table& table) const {
    AnswerTable mean = table.form;
    if (!mean.mean_title.empty()) mean.title = mean.mean_title;
    mean.title += fmt::format(", mean over {}", counted(moments_, "moment"));
    for (const auto& [key, sums] : table.rows) {
        std::vector<AnswerCell> row;
        for (std::size_t k = 0; k < mean.columns.size(); ++k) {
            const std::string& weight = mean.columns[k].weight;
            const double by = weight.empty() ? static_cast<double>(moments_) : sums.weight[k];
            if (weight == AnswerColumn::kKey)
                row.push_back(sums.keys[k]);
            else if (sums.values[k] > 0 && by > 0)
                row.emplace_back(sums.sum[k] / by);
            else
                row.emplace_back();
        }
        mean.rows.push_back(std::move(row));
    }
    return mean;
}

Answer MeanAnswer::mean() const {
    GRAINREEL_CHECK(moments_ > 0);
    Answer answer;
    for (const Table& table : tables_) {
        if (table.form.has_mean) {
            answer.tables.push_back(mean_of(table));
            continue;
        }
        answer.tables.push_back(table.form);
        answer.tables.back().title += fmt::format(", of {}", counted(moments_, "moment"));
    }
    return answer;
}

}  // namespace grainreel
