#include "render/app/options/parts_options.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

constexpr int most_parts = 100'000;

// "3/16"
PartsWanted parse_part(const std::string& text) {
    const auto number = [](const char* from, const char* to) {
        int value = 0;
        const auto [end, error] = std::from_chars(from, to, value);
        return error == std::errc() && end == to ? value : 0;
    };
    const std::size_t bar = std::min(text.find('/'), text.size());
    const char* const begin = text.data();
    const PartsWanted parts{number(begin, begin + bar),
                            bar < text.size() ? number(begin + bar + 1, begin + text.size()) : 0};
    if (parts.number < 1 || parts.of < parts.number || parts.of > most_parts)
        throw UserError(
            fmt::format("--part {}: is no part; write its number and how many there are, as in "
                        "3/16",
                        excerpt(text)));
    return parts;
}

// Whether a word, or it and the one after it, is that option.
bool is_option(const std::string& word, const std::string& option, bool& value_follows) {
    value_follows = word == option;
    return value_follows || word.rfind(option + "=", 0) == 0;
}

// The command without the options that the script gives itself.
std::vector<std::string> words_of_part(const std::vector<std::string>& words) {
    std::vector<std::string> kept;
    for (std::size_t k = 1; k < words.size(); ++k) {
        bool value_follows = false;
        if (is_option(words[k], "--slurm", value_follows) || is_option(words[k], "--out", value_follows))
            k += value_follows ? 1 : 0;
        else if (words[k] != "--force")
            kept.push_back(words[k]);
    }
    return kept;
}

}  // namespace

void add_parts(CLI::App& verb, std::optional<PartsWanted>& parts, int& slurm) {
    CLI::Option* part = verb.add_option_function<std::string>(
                                "--part", [&parts](const std::string& text) { parts = parse_part(text); },
                                "Draw one of several parts of the film, as in 3/16, for grainreel join")
                            ->type_name("K/N");
    CLI::Option* all = verb.add_option_function<int>(
                               "--parts",
                               [&parts](int of) {
                                   parts = PartsWanted{0, of};
                               },
                               "Draw the film in one go, with the bytes of so many joined parts")
                           ->check(CLI::Range(1, most_parts))
                           ->type_name("N");
    CLI::Option* script =
        verb.add_option("--slurm", slurm,
                        "Draw nothing; print a script that draws so many parts on a cluster and joins them\n"
                        "to the file of --out (docs/guide/clusters.md)")
            ->check(CLI::Range(1, most_parts))
            ->type_name("N");
    part->excludes(all);
    part->excludes(script);
    all->excludes(script);
}

std::string slurm_script(const std::vector<std::string>& words, int parts, const std::filesystem::path& where,
                         const std::filesystem::path& film) {
    bool replaces = false;
    for (const std::string& word : words) replaces = replaces || word == "--force";
    const std::string program = shell_word(words.front());
    const std::filesystem::path folder = film.parent_path() / (film.stem().string() + "-parts");
    const std::string of_parts = shell_word(folder.string());
    return fmt::format(
        R"(#!/bin/bash
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
# Draws a film in {0} parts, one in each task of an array, and joins them. Begin it by: bash THIS_FILE
set -e
cd {1}
mkdir -p {2}
case "${{1:-}}" in
    part) exec {3} {4} --part "$SLURM_ARRAY_TASK_ID/{0}" --force --out {2}/"$SLURM_ARRAY_TASK_ID" ;;
    join) exec {3} join {2}/{{1..{0}}} --out {5}{6} ;;
esac
array=$(sbatch --parsable --array=1-{0} "$0" part)
sbatch --dependency=afterok:"${{array%%;*}}" "$0" join
)",
        parts, shell_word(where.string()), of_parts, program, shell_words(words_of_part(words)),
        shell_word(film.string()), replaces ? " --force" : "");
}

}  // namespace grainreel
