// Writes study.csv, which has a row for each member.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

// A cell as RFC 4180 asks: in quotes when it has a comma, a quote or a line break.
std::string csv_cell(const std::string& text);
// The shortest decimal number that reads back to the same bits; empty for NaN.
std::string csv_number(double value);

// The table of members in their order, with the columns keys (with their units), seed, state, measures,
// error, folder.
std::string study_table(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results);

}  // namespace grainreel
