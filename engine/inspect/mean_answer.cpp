#include "engine/inspect/mean_answer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

// NaN where there is no number.
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

// Edges of bins come from products that differ in the last bits from moment to moment.
int compare(const AnswerCell& a, const AnswerCell& b) {
    const std::string* words = std::get_if<std::string>(&a);
    const std::string* others = std::get_if<std::string>(&b);
    if (words != nullptr && others != nullptr) return words->compare(*others);
    constexpr double hair = 1e-9;
    const double x = number_in(a), y = number_in(b);
    if (std::abs(x - y) <= hair * std::max({std::abs(x), std::abs(y), 1e-12})) return 0;
    return x < y ? -1 : 1;
}

}  // namespace

bool MeanAnswer::Key::operator<(const Key& other) const {
    for (std::size_t k = 0; k < cells.size(); ++k)
        if (const int order = compare(cells[k], other.cells[k]); order != 0) return order < 0;
    return false;
}

void MeanAnswer::add(const Answer& answer) {
    ++moments_;
    for (const AnswerTable& table : answer.tables) {
        if (!table.has_mean) continue;
        auto known = std::find_if(tables_.begin(), tables_.end(),
                                  [&](const Table& one) { return one.form.name == table.name; });
        if (known == tables_.end()) {
            tables_.push_back({table, {}});
            known = tables_.end() - 1;
            known->form.rows.clear();
        }
        for (const std::vector<AnswerCell>& row : table.rows) add_row(*known, row);
    }
}

void MeanAnswer::add_row(Table& table, const std::vector<AnswerCell>& row) const {
    const std::vector<AnswerColumn>& columns = table.form.columns;
    Key key;
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (columns[k].weight == AnswerColumn::kKey) key.cells.push_back(row[k]);
    Sums& sums = table.rows[key];
    sums.sum.resize(columns.size(), 0);
    sums.weight.resize(columns.size(), 0);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const double value = number_in(row[k]);
        if (columns[k].weight == AnswerColumn::kKey || !std::isfinite(value)) continue;
        const double weight =
            columns[k].weight.empty() ? 1 : number_in(row[place_of(table.form, columns[k].weight)]);
        sums.sum[k] += weight * value;
        sums.weight[k] += weight;
    }
}

Answer MeanAnswer::mean() const {
    GRAINREEL_CHECK(moments_ > 0);
    Answer answer;
    for (const Table& table : tables_) {
        AnswerTable form = table.form;
        form.title += fmt::format(", mean over {} moments", moments_);
        for (const auto& [key, sums] : table.rows) {
            std::vector<AnswerCell> row;
            std::size_t next = 0;
            for (std::size_t k = 0; k < form.columns.size(); ++k) {
                const std::string& weight = form.columns[k].weight;
                const double by = weight.empty() ? static_cast<double>(moments_) : sums.weight[k];
                if (weight == AnswerColumn::kKey)
                    row.push_back(key.cells[next++]);
                else if (by > 0)
                    row.emplace_back(sums.sum[k] / by);
                else
                    row.emplace_back();
            }
            form.rows.push_back(std::move(row));
        }
        answer.tables.push_back(std::move(form));
    }
    return answer;
}

}  // namespace grainreel
