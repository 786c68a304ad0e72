// The verb `manual` writes man pages from the data of --help. grainreel.1 lists the verbs; each verb has
// grainreel-VERB.1.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "render/app/command_line.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {

namespace {

// Escapes a text for roff, which interprets a backslash anywhere, and a dot or an apostrophe at the start of
// a line. A plain "-" would become a hyphen, which cannot be pasted into a shell.
std::string roff(const std::string& text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == '\\')
            safe += "\\e";
        else if (letter == '-')
            safe += "\\-";
        else
            safe += letter;
    }
    if (!safe.empty() && (safe[0] == '.' || safe[0] == '\'')) safe.insert(0, "\\&");
    return safe;
}

std::string heading(const std::string& name, const std::string& about, const std::string& version) {
    std::string upper = name;
    for (char& letter : upper)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    return fmt::format(".TH {} 1 \"\" \"grainreel {}\" \"grainreel manual\"\n.SH NAME\n{} \\- {}\n",
                       roff(upper), roff(version), roff(name), roff(about));
}

std::string bold(const std::string& word) {
    return "\\fB" + roff(word) + "\\fR";
}

std::string italic(const std::string& word) {
    return "\\fI" + roff(word) + "\\fR";
}

std::string paragraph(const CommandOption& option, bool positional) {
    std::string head;
    if (positional) {
        head = italic(option.names.front());
    } else {
        for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + bold(name);
        if (!option.flag()) head += " " + italic(option.value);
    }
    std::string about = option.about;
    if (!option.values.empty() && about.find(option.values.front()) == std::string::npos) {
        about += " (";
        for (const std::string& word : option.values)
            about += (word == option.values.front() ? "" : ", ") + word;
        about += ")";
    }
    return ".TP\n" + head + "\n" + roff(about) + "\n";
}

std::string synopsis(const CommandVerb& verb) {
    std::string line =
        ".SH SYNOPSIS\n" + bold("grainreel") + " " + bold(verb.name) + " [" + italic("OPTIONS") + "]";
    for (const CommandOption& one : verb.positionals) {
        const std::string name = italic(one.names.front()) + (one.repeated ? " ..." : "");
        line += one.required ? " " + name : " [" + name + "]";
    }
    return line + "\n";
}

// The notes below the options. Lines that --help aligns keep their form.
std::string notes(const std::vector<std::string>& lines) {
    if (lines.empty()) return "";
    std::string text = ".SH NOTES\n.nf\n";
    for (const std::string& line : lines) text += (line.empty() ? "" : roff(line)) + "\n";
    return text + ".fi\n";
}

std::string program_man_page(const std::vector<CommandVerb>& verbs, const std::string& about,
                             const std::string& version) {
    std::string first = about;
    if (!first.empty() && first.back() == '.') first.pop_back();
    std::string page = heading("grainreel", first, version);
    page +=
        ".SH SYNOPSIS\n" + bold("grainreel") + " " + italic("VERB") + " [" + italic("OPTIONS") + "] ...\n";
    page += ".SH VERBS\n";
    for (const CommandVerb& verb : verbs)
        page += ".TP\n" + bold(verb.name) + "\n" + roff(verb.about) + ". See " +
                bold("grainreel-" + verb.name) + "(1).\n";
    page += ".SH ENVIRONMENT\n.TP\n" + bold("GRAINREEL_OUTPUT") +
            "\nFolder for new runs if no other is given [output]\n.TP\n" + bold("GRAINREEL_GL") +
            "\nOpenGL that draws: osmesa or egl [osmesa]\n.TP\n" + bold("XDG_CACHE_HOME") +
            "\nIts folder grainreel has files that can be made again [~/.cache]\n";
    page +=
        ".SH EXIT STATUS\n.TP\n0\nDone.\n.TP\n1\nThe run failed; what it had is kept.\n.TP\n2\nA mistake in "
        "a file "
        "or an option; nothing was written.\n.TP\n129, 130, 143\nStopped by SIGHUP, Ctrl\\-C or SIGTERM; "
        "files "
        "are whole.\n";
    page +=
        ".SH EXAMPLES\n.nf\ngrainreel scenes\ngrainreel movie wedge_segregation\ngrainreel render "
        "output/wedge_segregation \\-\\-at 2 \\-\\-out still.png\n.fi\n";
    return page;
}

std::string verb_man_page(const CommandVerb& verb, const std::string& version) {
    std::string about = verb.about;
    std::string page = heading("grainreel-" + verb.name, about, version) + synopsis(verb);
    if (!verb.positionals.empty()) page += ".SH ARGUMENTS\n";
    for (const CommandOption& one : verb.positionals) page += paragraph(one, true);
    std::string group;
    for (const CommandOption& one : verb.options) {
        if (one.group.empty()) continue;
        if (one.group != group) page += fmt::format(".SH \"{}\"\n", roff(group = one.group));
        page += paragraph(one, false);
    }
    return page + notes(verb.notes) + ".SH SEE ALSO\n" + bold("grainreel") + "(1)\n";
}

class Manual final : public Verb {
  public:
    Manual()
        : Verb("manual",
               "Print the man page of the program or of a verb, or write all man pages into a folder",
               "To read one:  grainreel manual render | man -l -\n"
               "Exit status: 0 done, 1 a file cannot be written, 2 a mistake in the options.") {}

    void add_options(CLI::App& parser) override {
        CLI::Option* verb =
            parser.add_option("VERB", verb_, "A verb [the program itself]")->type_name("VERB");
        parser.add_option("--out", out_, "Folder for grainreel.1 and a page for each verb; it is made")
            ->type_name("DIR")
            ->check(not_empty())
            ->excludes(verb);
    }

    int run(Reporter&) override {
        const auto verbs = all_verbs();
        const std::vector<CommandVerb> table = command_table(*make_parser(verbs));
        if (out_)
            write_all(table);
        else
            print_result(page_of(table));
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    std::string page_of(const std::vector<CommandVerb>& table) const {
        if (verb_.empty()) return program_man_page(table, about_program, build_info::version);
        std::vector<std::string> names;
        for (const CommandVerb& verb : table) {
            if (verb.name == verb_) return verb_man_page(verb, build_info::version);
            names.push_back(verb.name);
        }
        throw UserError("no verb is called '{}'; there are {}", excerpt(verb_), fmt::join(names, ", "));
    }

    void write_all(const std::vector<CommandVerb>& table) const {
        std::filesystem::create_directories(*out_);
        const auto write = [&](const std::string& name, const std::string& page) {
            replace_file(*out_ / (name + ".1"), page);
        };
        write("grainreel", program_man_page(table, about_program, build_info::version));
        for (const CommandVerb& verb : table)
            write("grainreel-" + verb.name, verb_man_page(verb, build_info::version));
    }

    std::string verb_;
    std::optional<std::filesystem::path> out_;
};

}  // namespace

std::unique_ptr<Verb> manual_verb() {
    return std::make_unique<Manual>();
}

}  // namespace grainreel
