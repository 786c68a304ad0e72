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
};

// Empty, a number in SI, a count, or words.
using AnswerCell = std::variant<std::monostate, double, std::int64_t, std::string>;

struct AnswerTable {
    std::string name;   // of letters, digits and _
    std::string title;  // a line for people
    std::vector<AnswerColumn> columns;
    std::vector<std::vector<AnswerCell>> rows;  // a cell a column
};

struct Answer {
    std::vector<AnswerTable> tables;
    std::vector<std::string> notes;  // sentences
};

}  // namespace grainreel
