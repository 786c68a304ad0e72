// The mean of the answers to one question, over several moments.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "engine/inspect/answer.hpp"

namespace grainreel {

// Rows with the same keys (AnswerColumn::kKey) are one row of the mean. Counts and sums are divided by the
// number of moments, and a row that a moment lacks counts as 0 there. A column with a weight becomes the mean
// over all that weighs, as in sum(grains * mean_speed) / sum(grains). Tables that have no mean
// (AnswerTable::has_mean) are left out.
class MeanAnswer {
  public:
    void add(const Answer& answer);
    // Of at least one.
    Answer mean() const;

  private:
    // By the row's keys, so that rows come in their order.
    struct Key {
        std::vector<AnswerCell> cells;
        bool operator<(const Key& other) const;
    };
    struct Sums {
        std::vector<double> sum, weight;  // a column each
    };
    struct Table {
        AnswerTable form;  // without rows
        std::map<Key, Sums> rows;
    };
    void add_row(Table& table, const std::vector<AnswerCell>& row) const;

    std::vector<Table> tables_;
    std::size_t moments_ = 0;
};

}  // namespace grainreel
