// What a study warns of: the warnings of its members, told once each with the members that gave them, and
// measures that did not come up everywhere.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/results/results.hpp"

namespace grainreel {

struct SharedWarning {
    std::string text;  // "from 0.49 to 2.1 s on the bed ...": where members differ in a number, its range
    std::vector<std::size_t> members;
};
// Warnings that differ in numbers alone are one. They stand in the order of their first member.
std::vector<SharedWarning> shared_warnings(const std::vector<MemberResult>& results);

// "\u0393 = 4, seeds 1, 2; \u0393 = 5, seed 1": the members by their settings.
std::string members_text(const Study& study, const std::vector<Member>& members,
                         const std::vector<std::size_t>& which);

// The lines with which a study ends: its gaps, a line for each measure that lacks values, for their settings
// have no mean; then the first of its members' warnings.
std::vector<std::string> study_warnings(const Study& study, const std::vector<Member>& members,
                                        const std::vector<MemberResult>& results);

}  // namespace grainreel
