// What a question is answered with: tables, the same for people, for programs and for spreadsheets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct AnswerColumn {
    std::string name;  // of letters, digits and _
    Dimension dimension = Dimension::number;
    std::string about{};
    // For means over moments (mean_answer.hpp): kKey in columns that say which row it is; kThere where
    // moments without a value have no say; else the column that weighs this one. Empty: a sum, of which a
    // moment without the row has 0.
    std::string weight{};
    std::string unit{};  // of a pure number that has one: "m3"
    static constexpr const char *kKey = "key", *kThere = "there";
};

// Empty, a number in SI, a count, or words.
using AnswerCell = std::variant<std::monostate, double, std::int64_t, std::string>;

struct AnswerTable {
    std::string name;   // of letters, digits and _
    std::string title;  // a line for people
    std::vector<AnswerColumn> columns;
    std::vector<std::vector<AnswerCell>> rows;  // a cell a column
    bool has_mean = false;                      // whether rows of several moments can be joined
    // Where each row is a quantity of its own: theirs, of the columns of numbers.
    std::vector<Dimension> row_dimensions{};
    std::string mean_title{};  // in place of the title, where that says more of the moment than of the table
    // A list of those with most of this column. Of several moments it has those with most at any of them.
    std::string most_of{};
};

// The moment that an answer is about.
struct AnswerMoment {
    double time = 0;  // s; NaN when it is not known
    std::int64_t step = 0;
    std::string how;  // "kept moment 3 of 20", "brought back"
};

struct Answer {
    std::vector<AnswerTable> tables;
    std::vector<std::string> notes;  // sentences
    std::optional<AnswerMoment> moment{};
    // Ids of all grains of the answer, where the tables list only some of them.
    std::optional<std::vector<std::int32_t>> grains{};
};

// Ids that an answer names: of its tables' columns "id", and of contacts "first" and "second".
std::vector<std::int32_t> grains_in(const Answer& answer);

// The mean of the answers to one question, over several moments.

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
