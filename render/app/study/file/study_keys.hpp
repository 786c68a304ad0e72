// The keys that a study file may have.
#pragma once

#include <vector>

#include "engine/scene/keys/keys.hpp"

namespace grainreel {

// With the meanings that docs/reference/studies.md lists.
const std::vector<Key>& study_keys();

}  // namespace grainreel
