// The command line: words in, a verb that knows what they say out.
#pragma once

#include <memory>
#include <vector>

#include <CLI/App.hpp>

#include "render/app/verbs/verbs.hpp"

namespace grainreel {

inline constexpr const char* about_program =
    "One scene file becomes a film of vibrated grains and the numbers behind it.";

// The parser of all verbs. It writes into them, so they must live as long.
std::unique_ptr<CLI::App> make_parser(const std::vector<std::unique_ptr<Verb>>& verbs);

// Null when the words ask for help or the version, which then has been printed as the result. Throws
// UserError for words that make no sense.
std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv);

}  // namespace grainreel
