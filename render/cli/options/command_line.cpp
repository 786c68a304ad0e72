#include "render/cli/options/command_line.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "engine/base/error.hpp"
#include "engine/base/shell_word.hpp"
#include "engine/base/utf8.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/report/version.hpp"
#include "render/cli/verbs/verbs.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_of_a_mistake = 300;  // characters of what CLI11 says

using Verbs = std::vector<std::unique_ptr<Verb>>;

void check_verb(const Verbs& verbs, const std::string& word) {
    std::vector<std::string> names;
    for (const auto& verb : verbs) names.push_back(verb->name());
    if (word[0] == '-' || std::find(names.begin(), names.end(), word) != names.end()) return;
    throw UserError(
        fmt::format("{}; there are {}; see grainreel --help",
                    word.empty() ? "no command" : fmt::format("unknown command '{}'", excerpt(word)),
                    fmt::join(names, ", ")));
}

void add_verb(CLI::App& app, Verb& verb) {
    CLI::App& parser = *app.add_subcommand(verb.name(), verb.about());
    verb.add_options(parser);
    parser.footer(verb.footer());
}

void add_all(CLI::App& app, const Verbs& verbs) {
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text());
    app.get_formatter()->column_width(28);
    app.footer(
        "Begin with:  grainreel movie scenes/wedge_segregation.toml\n"
        "More about a verb:  grainreel movie --help");
    for (const auto& verb : verbs) add_verb(app, *verb);
}

}  // namespace

std::unique_ptr<Verb> parse_command_line(int argc, const char* const* argv) {
    Verbs verbs = all_verbs();
    CLI::App app("One scene file becomes a film of vibrated grains and the numbers behind it.", "grainreel");
    add_all(app, verbs);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        std::ostringstream text;
        app.exit(help, text, text);
        print_result(text.str());
        return nullptr;
    } catch (const CLI::ParseError& mistake) {
        check_verb(verbs, argc > 1 ? argv[1] : "");
        throw UserError(fmt::format("{}; see grainreel --help", excerpt(mistake.what(), most_of_a_mistake)));
    }
    const auto chosen = std::find_if(verbs.begin(), verbs.end(),
                                     [&](const auto& verb) { return app.got_subcommand(verb->name()); });
    GRAINREEL_CHECK(chosen != verbs.end());
    (*chosen)->command = shell_words({argv, argv + argc});
    return std::move(*chosen);
}

}  // namespace grainreel
