// What a question is answered with: tables, the same for people, for programs and for spreadsheets.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct AnswerColumn {
    std::string name;  // of letters, digits and _
    Dimension dimension = Dimension::number;
    std::string about{};
    // For means over moments (mean_answer.hpp): kKey in columns that say which row it is, else the column
    // that weighs this one; empty: nothing does.
    std::string weight{};
    static constexpr const char* kKey = "key";
};

// Empty, a number in SI, a count, or words.
using AnswerCell = std::variant<std::monostate, double, std::int64_t, std::string>;

struct AnswerTable {
    std::string name;   // of letters, digits and _
    std::string title;  // a line for people
    std::vector<AnswerColumn> columns;
    std::vector<std::vector<AnswerCell>> rows;  // a cell a column
    bool has_mean = false;                      // whether rows of several moments can be joined
};

struct Answer {
    std::vector<AnswerTable> tables;
    std::vector<std::string> notes;  // sentences
};

}  // namespace grainreel
