// Makes index.html, the page of a study for a browser.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/members/runner.hpp"
#include "render/page/facts/methods.hpp"

namespace grainreel {

// The page's text. Paths are relative to the study's folder, where posters and films are looked for. charts:
// the names of the files in charts/, without their endings. notes: sentences without
// full stops that stand below the table. methods: for a paper; without a paragraph for none.
std::string study_page(const Study& study, const std::vector<Member>& members,
                       const std::vector<MemberResult>& results, const StudyFolder& folder,
                       const std::vector<std::string>& charts, const std::vector<std::string>& notes = {},
                       const Methods& methods = {});

}  // namespace grainreel
