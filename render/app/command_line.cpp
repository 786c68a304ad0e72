#include "render/app/command_line.hpp"

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_of_a_mistake = 300;  // characters that are shown of CLI11's message

using Verbs = std::vector<std::unique_ptr<Verb>>;

void check_verb(const Verbs& verbs, const std::string& word) {
    std::vector<std::string> names;
    for (const auto& verb : verbs) names.push_back(verb->name());
    if (word[0] == '-' || std::find(names.begin(), names.end(), word) != names.end()) return;
    const std::optional<std::string> meant = nearest_name(word, names);
    throw UserError(fmt::format(
        "{}; {}there are {}; see grainreel --help",
        word.empty() ? "no command" : fmt::format("unknown command '{}'", excerpt(word)),
        meant && !word.empty() ? fmt::format("did you mean '{}'? ", *meant) : "", fmt::join(names, ", ")));
}

// The option's name in a word: "--duratoin" for "--duratoin=3". Empty when the word is no option.
std::string option_name(const std::string& word) {
    return word.compare(0, 2, "--") == 0 && word.size() > 2 ? word.substr(0, word.find('=')) : "";
}

// Throws for the first option that the verb does not have, if there is one.
void check_options(const Verb& verb, const CLI::App& parser, int argc, const char* const* argv) {
    std::vector<std::string> names = {"--help"};
    for (const CLI::Option* option : parser.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (int i = 2; i < argc && std::string_view(argv[i]) != "--"; ++i) {
        const std::string word = option_name(argv[i]);
        if (word.empty() || std::find(names.begin(), names.end(), word) != names.end()) continue;
        const std::optional<std::string> meant = nearest_name(word, names);
        throw UserError(fmt::format("unknown option '{}'; {}see grainreel {} --help", excerpt(word),
                                    meant ? fmt::format("did you mean '{}'? ", *meant) : "", verb.name()));
    }
}

// A formatter of help whose line for an option does not name all the options that it excludes.
class ShortFormatter final : public CLI::Formatter {
  public:
    std::string make_option_opts(const CLI::Option* option) const override {
        constexpr std::size_t most_named = 3;
        std::string text = CLI::Formatter::make_option_opts(option);
        if (option->get_excludes().size() > most_named)
            text.erase(std::min(text.size(), text.find(" Excludes:")));
        return text;
    }
};

void add_verb(CLI::App& app, Verb& verb) {
    CLI::App& parser = *app.add_subcommand(verb.name(), verb.about());
    verb.add_options(parser);
    parser.footer(verb.footer());
}

}  // namespace

std::unique_ptr<CLI::App> make_parser(const Verbs& verbs) {
    auto app = std::make_unique<CLI::App>(about_program, "grainreel");
    app->require_subcommand(1);
    app->set_version_flag("--version", std::function<std::string()>(version_text));
    app->formatter(std::make_shared<ShortFormatter>());
    app->get_formatter()->column_width(28);
    app->footer(
        "Begin with:  grainreel movie scenes/wedge_segregation.toml\n"
        "More about a verb:  grainreel movie --help");
    for (const auto& verb : verbs) add_verb(*app, *verb);
    return app;
}

std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv) {
    Verbs verbs = all_verbs();
    const std::unique_ptr<CLI::App> parser = make_parser(verbs);
    CLI::App& app = *parser;
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        std::ostringstream text;
        app.exit(help, text, text);
        print_result(text.str());
        return nullptr;
    } catch (const CLI::ParseError& mistake) {
        check_verb(verbs, argc > 1 ? argv[1] : "");
        for (const auto& verb : verbs)
            if (app.got_subcommand(verb->name()))
                check_options(*verb, *app.get_subcommand(verb->name()), argc, argv);
        throw UserError(fmt::format("{}; see grainreel --help", excerpt(mistake.what(), most_of_a_mistake)));
    }
    const auto chosen = std::find_if(verbs.begin(), verbs.end(),
                                     [&](const auto& verb) { return app.got_subcommand(verb->name()); });
    GRAINREEL_CHECK(chosen != verbs.end());
    (*chosen)->typed_words = {argv, argv + argc};
    (*chosen)->command = shell_words((*chosen)->typed_words);
    return std::move(*chosen);
}

}  // namespace grainreel
