// The command line: words in, a verb that knows what they say out.
#pragma once

#include <memory>

#include "render/app/verbs/verb.hpp"

namespace grainreel {

// Null when the words ask for help or the version, which then has been printed as the result. Throws
// UserError for words that make no sense.
std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv);

}  // namespace grainreel
