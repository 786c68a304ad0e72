// The answer to a question about a run: tables, from which the output for people, programs and spreadsheets
// is made. Also the means of such tables over several moments.
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
    std::string name;  // letters, digits and _
    Dimension dimension = Dimension::number;
    std::string about{};
    // How a mean over moments treats the column. kKey: its value identifies the row. kThere: moments without
    // a value do not count. The name of another column: that column holds the weights. Empty: the value is a
    // sum, and a moment without the row counts as 0.
    std::string weight{};
    std::string unit{};  // the unit to show if `dimension` has no unit of its own: "m3"
    static constexpr const char *kKey = "key", *kThere = "there";
};

// A cell is empty, or holds a number in SI, a count, or words.
using AnswerCell = std::variant<std::monostate, double, std::int64_t, std::string>;

struct AnswerTable {
    std::string name;   // letters, digits and _ only
    std::string title;  // a line for people
    std::vector<AnswerColumn> columns;
    std::vector<std::vector<AnswerCell>> rows;  // one cell for each column
    bool has_mean = false;                      // whether rows of several moments can be joined
    // Dimension of the numbers in each row, where each row is a quantity of its own.
    std::vector<Dimension> row_dimensions{};
    std::string mean_title{};  // the title of a mean, if the title names one moment
    // The column whose largest values the rows list, or empty. A mean over moments lists the largest of all
    // moments.
    std::string most_of{};
};

// The moment that an answer is about.
struct AnswerMoment {
    double time = 0;                     // s; NaN when it is not known
    std::optional<std::int64_t> step{};  // none where the files have no steps
    std::string how;  // where it comes from: "kept moment 3 of 20", "brought back" (computed again)
};

struct Answer {
    std::vector<AnswerTable> tables;
    std::vector<std::string> notes;  // sentences
    std::optional<AnswerMoment> moment{};
    // Ids of all grains of the answer, where the tables list only some of them.
    std::optional<std::vector<std::int32_t>> grains{};
};

// The ids that an answer names: in columns "id" of its tables, and "first" and "second" of contacts.
std::vector<std::int32_t> grains_in(const Answer& answer);

// The mean of the answers to one question, over several moments.

// Rows with the same keys (AnswerColumn::kKey) become one row of the mean. Counts and sums are divided by
// the number of moments; a row that a moment lacks counts as 0 there. A column with a weight becomes the
// weighted mean over all rows of its key, as in sum(grains * mean_speed) / sum(grains). A list of largest
// values (AnswerTable::most_of) has those of all moments, with the time of each. Other tables without a mean
// (AnswerTable::has_mean) are left out.
class MeanAnswer {
  public:
    // most: number of rows in a list of largest values.
    explicit MeanAnswer(std::size_t most) : most_(most) {}

    void add(const Answer& answer, double time);  // time of the moment, s
    // The mean of the answers so far; there must be at least one.
    Answer mean() const;

  private:
    // Keys are ordered: numbers by size, words in the order in which they came.
    using Key = std::vector<double>;
    struct NearlyLess {
        bool operator()(const Key& one, const Key& other) const;
    };
    struct Sums {
        std::vector<AnswerCell> keys;             // as the first row had them
        std::vector<double> sum, weight, values;  // one for each column; `values` counts the values
    };
    struct Table {
        AnswerTable form;                // name, title and columns; for a list of largest values its rows too
        std::vector<std::string> words;  // all words of keys so far
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
