// Man pages: grainreel.1, which lists the verbs, and grainreel-VERB.1.
#pragma once

#include <string>
#include <vector>

#include "render/app/verbs/command_table.hpp"

namespace grainreel {

// about: one sentence on the program. version: "1.0.0". Text for `man`, in the man macros of roff.
std::string program_man_page(const std::vector<CommandVerb>& verbs, const std::string& about,
                             const std::string& version);
std::string verb_man_page(const CommandVerb& verb, const std::string& version);

}  // namespace grainreel
