#include "render/app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/names.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_of_a_mistake = 300;  // characters that are shown of CLI11's message

using Verbs = std::vector<std::unique_ptr<Verb>>;

void check_verb(const Verbs& verbs, const std::string& word) {
    std::vector<std::string> names;
    for (const auto& verb : verbs) names.push_back(verb->name());
    if (word[0] == '-' || contains(names, word)) return;
    std::optional<std::string> meant = nearest_name(word, names);
    if (word.ends_with(".toml")) meant = "movie " + excerpt(word);
    throw UserError("{}; {}there are {}; see {} --help",
                    word.empty() ? "no command" : fmt::format("unknown command '{}'", excerpt(word)),
                    meant && !word.empty() ? fmt::format("did you mean '{}'? ", *meant) : "",
                    fmt::join(names, ", "), program_call());
}

// The option's name in a word: "--duratoin" for "--duratoin=3". Empty when the word is not a long option.
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
        if (word.empty() || contains(names, word)) continue;
        const std::optional<std::string> meant = nearest_name(word, names);
        throw UserError("unknown option '{}'; {}see {} {} --help", excerpt(word),
                        meant ? fmt::format("did you mean '{}'? ", *meant) : "", program_call(), verb.name());
    }
}

// Texts stay as they are written. CLI11 2.5 and newer would else break their lines anew, without their
// columns.
template <typename Formatter>
void keep_lines(Formatter& formatter) {
    if constexpr (requires { formatter.enable_footer_formatting(false); }) {
        constexpr std::size_t no_limit = 1000;  // letters
        formatter.enable_description_formatting(false);
        formatter.enable_footer_formatting(false);
        formatter.right_column_width(no_limit);
    }
}

// A formatter of help that leaves out the list of excluded options where the list is long.
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

// The text of a help page, with the program named in its commands as the user calls it.
std::string as_called(std::string text) {
    const std::string name = "grainreel ", call = program_call() + " ";
    for (std::size_t place = 0; (place = text.find(name, place)) != std::string::npos; place += call.size())
        text.replace(place, name.size(), call);
    return text;
}

void add_verb(CLI::App& app, Verb& verb) {
    CLI::App& parser = *app.add_subcommand(verb.name(), verb.about());
    verb.add_options(parser);
    for (CLI::Option* option : parser.get_options())
        option->description(as_called(option->get_description()));
    parser.footer(as_called(verb.footer()));
}

// What gives the help about the words: of their verb, if they have one.
std::string help_about(const CLI::App& app, const Verbs& verbs) {
    for (const auto& verb : verbs)
        if (app.got_subcommand(verb->name()))
            return fmt::format("{} {} --help", program_call(), verb->name());
    return program_call() + " --help";
}

// The type of an option without the checks that CLI11 adds to it, as in "N:INT in [1 - 10]" or
// "CASE:{wedge,sea}".
std::string plain_type(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

std::vector<std::string> pieces(const std::string& text, char border) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string piece; std::getline(in, piece, border);) all.push_back(piece);
    return all;
}

// The values that an option's check by CLI11 allows. CLI11 writes them into the type, as in
// "CASE:{wedge,sea}".
std::vector<std::string> words_of_check(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const auto begin = type.find(":{"), end = type.find('}');
    if (begin == std::string::npos || end == std::string::npos) return {};
    return pieces(type.substr(begin + 2, end - begin - 2), ',');
}

// The values of options that check their values themselves. A list that is written out here must name what
// the option accepts (provider_of(), progress_form() and set_moves_with() in render/app/options).
std::vector<std::string> words_of(const std::string& option) {
    if (option == "--format") return all_of(film_format_words);
    if (option == "--for") return purpose_names();
    if (option == "--gl") return {"osmesa", "egl"};
    if (option == "--progress") return {"auto", "json", "none"};
    if (option == "--units") return unit_names();
    if (option == "--moves-with") return {"lab", "container"};
    return {};
}

CommandOption option_of(const CLI::Option& option) {
    CommandOption one;
    if (option.get_positional()) {
        one.names = {option.get_name(true)};
    } else {
        for (const std::string& name : option.get_snames()) one.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) one.names.push_back("--" + name);
    }
    one.value = option.get_expected_max() == 0 ? "" : plain_type(option);
    one.about = option.get_description();
    one.group = option.get_group();
    one.required = option.get_required();
    one.repeated =
        option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    one.values = words_of_check(option);
    if (one.values.empty()) one.values = words_of(one.names.back());
    return one;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return contains(words, word);
}

}  // namespace

std::unique_ptr<CLI::App> make_parser(const Verbs& verbs) {
    auto app = std::make_unique<CLI::App>(about_program, program_call());
    app->require_subcommand(1);
    app->set_version_flag("--version", std::function<std::string()>(version_text));
    app->formatter(std::make_shared<ShortFormatter>());
    app->get_formatter()->column_width(28);
    keep_lines(*app->get_formatter());
    app->footer(
        as_called("Begin with:  grainreel movie wedge_segregation\n"
                  "More about a verb:  grainreel movie --help\n"
                  "From a question to a film or a figure: docs/guide/lesson.md for a lesson, "
                  "docs/guide/paper.md for a paper"));
    for (const auto& verb : verbs) add_verb(*app, *verb);
    return app;
}

namespace {

// Whether at least the first three words are files, as a pattern without quotes gives them.
bool are_files(const char* const* words, int count) {
    std::error_code none;
    return count >= 3 && std::all_of(words, words + 3, [&](const char* word) {
               return std::filesystem::is_regular_file(word, none);
           });
}

// What to type, for somebody who named no scene.
std::string advice_without_scene(const std::string& verb) {
    const std::string call = program_call();
    return fmt::format(
        "{} needs a scene; type for example:  {} {} wedge_segregation   ({} scenes lists those that "
        "come with the program, {} new writes one to change)",
        verb, call, verb, call, call);
}

}  // namespace

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
        if (dynamic_cast<const CLI::RequiredError*>(&mistake) != nullptr &&
            std::string_view(mistake.what()) == "SCENE is required")
            throw UserError(advice_without_scene(app.get_subcommands().front()->get_name()));
        if (dynamic_cast<const CLI::ExtrasError*>(&mistake) != nullptr && argc > 4 &&
            are_files(argv + 2, argc - 2))
            throw UserError(
                "{}: one file or pattern is taken, and the shell made {} files of it; put the pattern in "
                "quotes, or give the folder",
                argv[1], argc - 2);
        throw UserError("{}; see {}", excerpt(mistake.what(), most_of_a_mistake), help_about(app, verbs));
    }
    const auto chosen = std::find_if(verbs.begin(), verbs.end(),
                                     [&](const auto& verb) { return app.got_subcommand(verb->name()); });
    GRAINREEL_CHECK(chosen != verbs.end());
    (*chosen)->typed_words = {argv, argv + argc};
    (*chosen)->command = shell_words((*chosen)->typed_words);
    return std::move(*chosen);
}

bool CommandOption::takes_file() const {
    return is_one_of(value, {"FILE", "DIR", "PATH", "FILE|DIR"});
}

std::vector<CommandVerb> command_table(const CLI::App& program) {
    std::vector<CommandVerb> table;
    for (const CLI::App* parser : program.get_subcommands([](const CLI::App*) { return true; })) {
        if (parser->get_group().empty()) continue;
        CommandVerb verb{
            parser->get_name(), parser->get_description(), pieces(parser->get_footer(), '\n'), {}, {}};
        for (const CLI::Option* option : parser->get_options())
            (option->get_positional() ? verb.positionals : verb.options).push_back(option_of(*option));
        table.push_back(std::move(verb));
    }
    return table;
}

}  // namespace grainreel
