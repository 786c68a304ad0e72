// The verbs of the command line and their common class.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"

namespace grainreel {

// A verb of the command line: its name, its options, and what it does. Each verb is one file of this folder
// and one word of the table in verbs.cpp.
class Verb {
  public:
    // about: a line for --help. footer: the text below the options in the verb's own help.
    Verb(std::string name, std::string about, std::string footer)
        : name_(std::move(name)), about_(std::move(about)), footer_(std::move(footer)) {}
    virtual ~Verb() = default;
    Verb(const Verb&) = delete;
    Verb& operator=(const Verb&) = delete;

    const std::string& name() const { return name_; }
    const std::string& about() const { return about_; }
    const std::string& footer() const { return footer_; }

    // Adds the verb's options to its parser, which writes their values into this object. Groups of options
    // that verbs share are in options/option_groups.hpp.
    virtual void add_options(CLI::App& parser) = 0;
    // Does what the options ask for and returns the exit status: 0; 1 when it failed on its way (what was
    // made so far is kept); 129, 130 or 143 when it was asked to stop. Throws UserError before anything is
    // written, and RunError when the work fails.
    virtual int run(Reporter& reporter) = 0;
    // Whether run() looks at stop_signal(); otherwise the first signal ends the program.
    virtual bool ends_in_good_order() const { return true; }

    ReporterOptions report;                // filled by add_reporting(), for verbs with that group
    std::string command;                   // the command as typed, for run.json
    std::vector<std::string> typed_words;  // the words of the command, the program first

  private:
    const std::string name_, about_, footer_;
};

// Makes all verbs, in the order of --help.
std::vector<std::unique_ptr<Verb>> all_verbs();

}  // namespace grainreel
