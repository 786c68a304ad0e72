// The copy of a study in its own folder: study.toml, its scene, and the files that both name. It is a study
// as it stands, so whoever has the folder and the program can run it again.
#pragma once

#include "render/app/study/members/runner.hpp"

namespace grainreel {

// Writes the copy. Throws RunError when that cannot be done.
void write_study_copy(const Study& study, const std::vector<Member>& members, const StudyFolder& folder);

}  // namespace grainreel
