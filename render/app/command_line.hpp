// Parses the command line into a verb with its options. It also makes the table of verbs and options from
// which man pages and completions for shells are written.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/app/options/cli.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {

inline constexpr const char* about_program =
    "One scene file becomes a film of vibrated grains and the numbers behind it.";

// Makes the parser of all verbs. It writes into the verbs, so they must outlive it.
std::unique_ptr<CLI::App> make_parser(const std::vector<std::unique_ptr<Verb>>& verbs);

// Returns the verb; null when the words ask for help or the version, which has then been printed. Throws
// UserError for words that make no sense.
std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv);

// An option in the table of the command line. The table is made from the parser that prints --help, so help,
// man pages and completion cannot differ.
struct CommandOption {
    std::vector<std::string> names;   // "-h", "--help"; a positional argument has one name, "SCENE"
    std::string value;                // how --help names its value, as in "DIR"; empty for a flag
    std::string about;                // one sentence or a few
    std::string group;                // heading in --help, "Options" unless the verb says otherwise
    bool required = false;            // the verb cannot do without it
    bool repeated = false;            // may be given several times
    std::vector<std::string> values;  // the words that it takes; empty where any may come

    bool flag() const { return value.empty(); }
    // Whether it takes the name of a file or a folder.
    bool takes_file() const;
    // Whether it takes a key of a scene, as in --set drive.frequency=20.
    bool takes_key() const { return value == "KEY=VALUE" || value == "KEY[=VALUE]"; }
    // Whether it takes a scene: a file, or the name of a scene that comes with the program.
    bool takes_scene() const { return names.front() == "SCENE"; }
};

struct CommandVerb {
    std::string name, about;
    std::vector<std::string> notes;  // lines below the options in --help
    std::vector<CommandOption> positionals, options;
};

// The verbs in the order of --help, without hidden ones.
std::vector<CommandVerb> command_table(const CLI::App& program);

}  // namespace grainreel
