// The verbs and options of the command line as a table. It is made from the parser that prints --help; man
// pages and completion for shells are written from it, so the three cannot differ.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grainreel {

struct CommandOption {
    std::vector<std::string> names;   // "-h", "--help"; a positional argument has one name, "SCENE"
    std::string value;                // "DIR"; empty for a flag
    std::string about;                // one sentence or a few
    std::string group;                // heading in --help, "Options" unless the verb says otherwise
    bool required = false;            //
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
