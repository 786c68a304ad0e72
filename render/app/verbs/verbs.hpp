// All verbs of the command line.
#pragma once

#include <memory>
#include <vector>

#include "render/app/verbs/verb.hpp"

namespace grainreel {

// In the order of --help.
std::vector<std::unique_ptr<Verb>> all_verbs();

}  // namespace grainreel
