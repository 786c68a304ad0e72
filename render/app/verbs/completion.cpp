// The verb `completion` writes a script with which a shell completes our command line: verbs, options, the
// words that an option takes, scenes, and the keys of a scene after --set.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"
#include "render/app/command_line.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// The words from which the scripts are made.
struct CompletionWords {
    std::vector<CommandVerb> verbs;
    std::vector<Key> keys;
    std::vector<std::string> scenes;  // names of those that come with the program
};

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

// The key as it is typed: "species[].count" needs an index, and the first one is offered.
std::string typed_key(const std::string& path) {
    std::string key = path;
    for (auto at = key.find("[]"); at != std::string::npos; at = key.find("[]", at))
        key.replace(at, 2, "[0]");
    return key;
}

std::vector<std::string> typed_keys(const std::vector<Key>& keys) {
    std::vector<std::string> all;
    for (const Key& key : keys) all.push_back(typed_key(key.path));
    return all;
}

std::vector<std::string> choices_of(const Key& key) {
    if (key.kind == KeyKind::flag) return {"true", "false"};
    return key.kind == KeyKind::choice ? key.choices : std::vector<std::string>{};
}

std::string option_names(const CommandVerb& verb) {
    std::vector<std::string> all;
    for (const CommandOption& option : verb.options)
        all.insert(all.end(), option.names.begin(), option.names.end());
    return joined(all);
}

std::vector<std::string> verb_names(const std::vector<CommandVerb>& verbs) {
    std::vector<std::string> names;
    for (const CommandVerb& verb : verbs) names.push_back(verb.name);
    return names;
}

std::vector<std::string> verbs_with_scenes(const std::vector<CommandVerb>& verbs) {
    std::vector<std::string> names;
    for (const CommandVerb& verb : verbs)
        for (const CommandOption& one : verb.positionals)
            if (one.takes_scene()) names.push_back(verb.name);
    return names;
}

// Puts a text into single quotes of a POSIX shell.
std::string in_quotes(const std::string& text) {
    std::string safe = "'";
    for (const char letter : text) safe += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return safe + "'";
}

// A short text for a menu: the first sentence, or the part before a bracket or a semicolon.
std::string short_about(const std::string& about) {
    return about.substr(
        0, std::min({about.find(';'), about.find(" ("), about.find(" ["), about.find(". "), about.size()}));
}

// The cases of a verb in bash: the words that may follow each option that takes a value.
std::string bash_cases(const CommandVerb& verb) {
    std::string text;
    for (const CommandOption& option : verb.options) {
        if (option.flag() || option.takes_key()) continue;
        const std::string names =
            verb.name + ":" + fmt::format("{}", fmt::join(option.names, "|" + verb.name + ":"));
        if (!option.values.empty())
            text += fmt::format("        {}) COMPREPLY=($(compgen -W {} -- \"$word\")); return ;;\n", names,
                                in_quotes(joined(option.values)));
        else if (option.takes_file())
            text += fmt::format(
                "        {}) compopt -o filenames; COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n",
                names);
        else
            text += fmt::format("        {}) return ;;\n", names);
    }
    return text;
}

// Escapes a text for "type:help:action" of zsh's _arguments, where colons and brackets must be escaped.
std::string zsh_text(const std::string& text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == ':' || letter == '[' || letter == ']' || letter == '\\') safe += '\\';
        safe += letter;
    }
    return safe;
}

std::string zsh_action(const CommandOption& option) {
    if (option.takes_key()) return "_grainreel_keys";
    if (option.takes_scene()) return "_grainreel_scenes";
    if (!option.values.empty()) return "(" + joined(option.values) + ")";
    return option.takes_file() ? "_files" : " ";
}

std::string zsh_option(const CommandOption& option, const std::string& name) {
    std::string spec = (option.repeated ? "*" : "") + name + "[" + zsh_text(short_about(option.about)) + "]";
    if (!option.flag()) spec += ":" + zsh_text(option.value) + ":" + zsh_action(option);
    return "                " + in_quotes(spec) + " \\\n";
}

std::string zsh_case(const CommandVerb& verb) {
    std::string text = fmt::format("        {})\n            _arguments \\\n", verb.name);
    for (const CommandOption& option : verb.options)
        for (const std::string& name : option.names) text += zsh_option(option, name);
    int place = 0;
    for (const CommandOption& one : verb.positionals) {
        const std::string where = one.repeated ? "*" : std::to_string(++place);
        text += "                " +
                in_quotes(where + ":" + zsh_text(one.names.front()) + ":" + zsh_action(one)) + " \\\n";
    }
    text.erase(text.size() - 3);
    return text + "\n            ;;\n";
}

std::string fish_option(const CommandVerb& verb, const CommandOption& option) {
    std::string line = fmt::format("complete -c grainreel -n '__fish_seen_subcommand_from {}'", verb.name);
    for (const std::string& name : option.names)
        line += name.compare(0, 2, "--") == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.flag()) line += " -r";
    if (option.takes_key())
        line += " -f -a '(__grainreel_keys)'";
    else if (!option.values.empty())
        line += " -f -a " + in_quotes(joined(option.values));
    else if (option.takes_file())
        line += " -F";
    else if (!option.flag())
        line += " -f";
    return line + " -d " + in_quotes(short_about(option.about)) + "\n";
}

std::string bash_completion(const CompletionWords& words) {
    std::string keys, options, values;
    for (const Key& key : words.keys)
        if (const auto choices = choices_of(key); !choices.empty())
            keys += fmt::format("        {}) printf '%s' {} ;;\n", in_quotes(typed_key(key.path)),
                                in_quotes(joined(choices)));
    for (const CommandVerb& verb : words.verbs) {
        options += fmt::format("        {}) printf '%s' {} ;;\n", verb.name, in_quotes(option_names(verb)));
        values += bash_cases(verb);
    }
    return fmt::format(
        R"~(# Completion of grainreel for bash. Written by: grainreel completion bash
_grainreel_choices() {{  # $1: a key of a scene; the words that it may have
    case $1 in
{keys}    esac
}}

_grainreel_options() {{  # $1: a verb; its options
    case $1 in
{options}    esac
}}

_grainreel() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}}
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "{verbs} --help --version" -- "$word"))
        return
    fi
    # bash takes "=" as a word of its own: --set KEY = VALUE.
    if [[ $word == '=' ]]; then before='=' word=''; set -- "${{COMP_WORDS[COMP_CWORD-1]}}" "${{COMP_WORDS[COMP_CWORD-2]}}"
    elif [[ $before == '=' ]]; then set -- "${{COMP_WORDS[COMP_CWORD-2]}}" "${{COMP_WORDS[COMP_CWORD-3]}}"
    else set -- '' ''; fi
    if [[ $before == '=' && $2 == --set ]]; then
        COMPREPLY=($(compgen -W "$(_grainreel_choices "$1")" -- "$word"))
        return
    fi
    [[ $before == '=' ]] && before=$1
    case $before in
        --set)
            compopt -o nospace 2>/dev/null
            COMPREPLY=($(compgen -S = -W "{all_keys}" -- "$word"))
            return ;;
    esac
    case $verb:$before in
{values}    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$(_grainreel_options "$verb")" -- "$word"))
        return
    fi
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
    case $verb in
        {scene_verbs}) COMPREPLY+=($(compgen -W "{scenes}" -- "$word")) ;;
    esac
}}
complete -F _grainreel grainreel
)~",
        fmt::arg("keys", keys), fmt::arg("options", options), fmt::arg("values", values),
        fmt::arg("verbs", joined(verb_names(words.verbs))),
        fmt::arg("all_keys", joined(typed_keys(words.keys))),
        fmt::arg("scene_verbs", fmt::format("{}", fmt::join(verbs_with_scenes(words.verbs), "|"))),
        fmt::arg("scenes", joined(words.scenes)));
}

std::string zsh_completion(const CompletionWords& words) {
    std::string verbs, cases, keys;
    for (const CommandVerb& verb : words.verbs) {
        verbs += "        " + in_quotes(zsh_text(verb.name) + ":" + verb.about) + "\n";
        cases += zsh_case(verb);
    }
    for (const Key& key : words.keys) keys += "        " + in_quotes(typed_key(key.path)) + "\n";
    return fmt::format(R"~(#compdef grainreel
# Completion of grainreel for zsh. Written by: grainreel completion zsh
_grainreel_keys() {{
    local -a keys=(
{keys}    )
    compadd -S = -a keys
}}

_grainreel_scenes() {{
    compadd {scenes}
    _files
}}

_grainreel() {{
    local -a verbs=(
{verbs}    )
    if ((CURRENT == 2)); then
        _describe verb verbs
        return
    fi
    local verb=$words[2]
    shift words
    ((CURRENT--))
    case $verb in
{cases}    esac
}}
_grainreel "$@"
)~",
                       fmt::arg("keys", keys), fmt::arg("scenes", joined(words.scenes)),
                       fmt::arg("verbs", verbs), fmt::arg("cases", cases));
}

std::string fish_completion(const CompletionWords& words) {
    std::string text = "# Completion of grainreel for fish. Written by: grainreel completion fish\n";
    text += "function __grainreel_keys\n    printf '%s\\n'";
    for (const std::string& key : typed_keys(words.keys)) text += " '" + key + "='";
    text += "\nend\ncomplete -c grainreel -n __fish_use_subcommand -f\n";
    text += "complete -c grainreel -n __fish_use_subcommand -l version -d 'Print the version'\n";
    for (const CommandVerb& verb : words.verbs)
        text += fmt::format("complete -c grainreel -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                            in_quotes(verb.about));
    for (const std::string& verb : verbs_with_scenes(words.verbs))
        text += fmt::format("complete -c grainreel -n '__fish_seen_subcommand_from {}' -a {}\n", verb,
                            in_quotes(joined(words.scenes)));
    for (const CommandVerb& verb : words.verbs)
        for (const CommandOption& option : verb.options) text += fish_option(verb, option);
    return text;
}

class Completion final : public Verb {
  public:
    Completion()
        : Verb("completion", "Print a script with which bash, zsh or fish completes this command line",
               "Try it in this shell:  source <(grainreel completion bash)\n"
               "To keep it, save it as bash-completion/completions/grainreel in ~/.local/share (bash), as "
               "_grainreel\n"
               "in a folder of $fpath (zsh), or as ~/.config/fish/completions/grainreel.fish (fish). A "
               "package of\n"
               "grainreel has them already.\n"
               "Exit status: 0 done, 2 a mistake in the options.") {}

    void add_options(CLI::App& parser) override {
        parser.add_option("SHELL", shell_, "The shell")
            ->required()
            ->type_name("WHICH")
            ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    }

    int run(Reporter&) override {
        const auto verbs = all_verbs();
        CompletionWords known{command_table(*make_parser(verbs)), filmed_scene_keys(), {}};
        for (const ShippedScene& scene : shipped_scenes()) known.scenes.push_back(scene.name);
        print_result(shell_ == "bash"  ? bash_completion(known)
                     : shell_ == "zsh" ? zsh_completion(known)
                                       : fish_completion(known));
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    std::string shell_;
};

}  // namespace

std::unique_ptr<Verb> completion_verb() {
    return std::make_unique<Completion>();
}

}  // namespace grainreel
