// The verb `manual`: man pages, written from what --help knows.
#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "build_info.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "render/app/command_line.hpp"
#include "render/app/manual/man_page.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

class Manual final : public Verb {
  public:
    Manual()
        : Verb("manual", "Print the man page of the program or of a verb, or write all of them into a folder",
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
        throw UserError(
            fmt::format("no verb is called '{}'; there are {}", excerpt(verb_), fmt::join(names, ", ")));
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
