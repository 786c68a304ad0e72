// The keys that a study file may have.
#pragma once

#include <vector>

#include "engine/scene/keys/keys.hpp"

namespace grainreel {

// Gives the keys with their meanings, which docs/reference/studies.md lists.
const std::vector<Key>& study_keys();

}  // namespace grainreel
