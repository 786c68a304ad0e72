// The mean of the answers to one question, over several moments.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"

namespace grainreel {

// Rows with the same keys (AnswerColumn::kKey) are one row of the mean. Counts and sums are divided by the
// number of moments, and a row that a moment lacks counts as 0 there. A column with a weight becomes the mean
// over all that weighs, as in sum(grains * mean_speed) / sum(grains). A list of those with most
// (AnswerTable::most_of) has those of all moments, with the time of each. Other tables that have no mean
// (AnswerTable::has_mean) are left out.
class MeanAnswer {
  public:
    // most: rows of a list.
    explicit MeanAnswer(std::size_t most) : most_(most) {}

    void add(const Answer& answer, double time);  // s, of the moment
    // The mean of the answers so far, of which there must be at least one.
    Answer mean() const;

  private:
    // Numbers in their order, words in the order in which they came.
    using Key = std::vector<double>;
    struct NearlyLess {
        bool operator()(const Key& one, const Key& other) const;
    };
    struct Sums {
        std::vector<AnswerCell> keys;             // as the first row had them
        std::vector<double> sum, weight, values;  // a column each; values: how many there were
    };
    struct Table {
        AnswerTable form;                // of a mean without rows
        std::vector<std::string> words;  // of keys
        std::map<Key, Sums, NearlyLess> rows;
    };
    Table& table_like(const AnswerTable& table);
    static Key key_of(Table& table, const std::vector<AnswerCell>& row);
    void add_row(Table& table, const std::vector<AnswerCell>& row) const;
    void add_list(AnswerTable& all, const AnswerTable& one, double time) const;
    AnswerTable mean_of(const Table& table) const;

    const std::size_t most_;
    std::vector<Table> tables_;
    std::size_t moments_ = 0;
};

}  // namespace grainreel
