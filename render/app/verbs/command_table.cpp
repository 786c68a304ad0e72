#include "render/app/verbs/command_table.hpp"

#include <algorithm>
#include <initializer_list>
#include <sstream>

#include "engine/files/foreign/names.hpp"
#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

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

// The words that a check of CLI11 allows.
std::vector<std::string> words_of_check(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const auto begin = type.find(":{"), end = type.find('}');
    if (begin == std::string::npos || end == std::string::npos) return {};
    return pieces(type.substr(begin + 2, end - begin - 2), ',');
}

// The words of options that check their words themselves. They come from the lists that those options use.
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
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

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
