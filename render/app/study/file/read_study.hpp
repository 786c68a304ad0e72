// Reads a study file, and gives the keys that such a file may have.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/study/study.hpp"

namespace grainreel {

// Throws UserError at the first mistake, "file:line:column: ...": a key that is unknown here or in the scene,
// a column that no run would have, a range without values. The values of the scene's keys are checked when
// members are made of them (members.hpp).
Study read_study(const std::filesystem::path& file);

// Gives the keys of a study file with their meanings, which docs/reference/studies.md lists.
const std::vector<Key>& study_keys();

}  // namespace grainreel
