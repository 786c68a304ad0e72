// Parses the command line: turns its words into a verb with its options.
#pragma once

#include <memory>
#include <vector>

#include <CLI/App.hpp>

#include "render/app/verbs/verbs.hpp"

namespace grainreel {

inline constexpr const char* about_program =
    "One scene file becomes a film of vibrated grains and the numbers behind it.";

// Makes the parser of all verbs. It writes into the verbs, so they must outlive it.
std::unique_ptr<CLI::App> make_parser(const std::vector<std::unique_ptr<Verb>>& verbs);

// Returns the verb; null when the words ask for help or the version, which has then been printed. Throws
// UserError for words that make no sense.
std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv);

}  // namespace grainreel
