// study.csv: a row a member.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

// A cell after RFC 4180: in quotes where it has a comma, a quote or a line's end.
std::string csv_cell(const std::string& text);
// Shortest decimals that read back to the same bits; empty for NaN.
std::string csv_number(double value);

// The members in their order: keys (with their unit), seed, state, measures, error, folder.
std::string study_table(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results);

}  // namespace grainreel
