// What a question is answered with: tables, the same for people, for programs and for spreadsheets.
#pragma once

#include <cstdint>
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

}  // namespace grainreel
