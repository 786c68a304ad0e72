#include "render/app/options/option_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "render/app/options/cli.hpp"
#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

CLI::Option* add_paper(CLI::App& verb, PaperOptions& options, const char* about) {
    CLI::Option* charts = add_typed(verb, "--charts", options.folder, about, "DIR")->check(not_empty());
    verb.add_option("--as", options.paper.forms, "With --charts: pdf, svg, png, or several with commas [pdf]")
        ->delimiter(',')
        ->check(CLI::IsMember({"pdf", "svg", "png"}))
        ->needs(charts)
        ->type_name("FORM");
    verb.add_option("--width-mm", options.paper.width_mm,
                    "With --charts: width on paper; letters have 8 points at any width [85]")
        ->check(number_within(40, 1000))
        ->needs(charts)
        ->type_name("MM");
    verb.add_option("--dpi", options.paper.dpi, "With --charts: pixels an inch of png [300]")
        ->check(number_within(50, 2400))
        ->needs(charts)
        ->type_name("N");
    return charts;
}

void check_paper(const PaperOptions& options) {
    if (options.folder && is_there(*options.folder) && !is_folder(*options.folder))
        throw UserError("--charts {}: is a file; name a folder", options.folder->string());
    constexpr double inch = 25.4, most_pixels = 20000;
    if (options.paper.width_mm / inch * options.paper.dpi > most_pixels)
        throw UserError(
            "--dpi {}: a chart {} mm wide would have more than {} pixels across; lower one of them",
            options.paper.dpi, options.paper.width_mm, most_pixels);
}

namespace {

constexpr int most_parts = 100'000;

// Parses the number of a part and the number of parts: "3/16".
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
            "--part {}: is no part; write its number and how many there are, as in "
            "3/16",
            excerpt(text));
    return parts;
}

// Whether the word is that option, with its value inside or in the next word.
bool is_option(const std::string& word, const std::string& option, bool& value_follows) {
    value_follows = word == option;
    return value_follows || word.rfind(option + "=", 0) == 0;
}

// The words of the command without its program, and without --slurm, --out and --force, which the script
// gives itself.
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
                               "Draw the film in one go, with the same bytes as N joined parts")
                           ->check(CLI::Range(1, most_parts))
                           ->type_name("N");
    CLI::Option* script = verb.add_option("--slurm", slurm,
                                          "Print a script that draws N parts on a cluster and joins them to "
                                          "the file of --out; draw nothing\n"
                                          "(docs/guide/clusters.md)")
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

namespace {

using Form = ReporterOptions::Form;

Form progress_form(const std::string& word) {
    const std::map<std::string, Form> forms = {
        {"auto", Form::automatic}, {"json", Form::json}, {"none", Form::none}};
    const auto form = forms.find(word);
    if (form == forms.end()) {
        throw UserError("--progress {}: no such form; choose auto, json or none", excerpt(word));
    }
    return form->second;
}

}  // namespace

void add_reporting(CLI::App& verb, ReporterOptions& report) {
    verb.add_option_function<std::string>(
            "--progress", [&report](const std::string& word) { report.form = progress_form(word); },
            "Progress: auto (a line that is redrawn on a terminal, or printed now and then in a pipe), json "
            "(an object a line) or none [auto]")
        ->type_name("FORM");
    verb.add_flag("--quiet", report.quiet, "Say nothing on stderr but errors");
    verb.add_flag("--verbose", report.verbose, "Say more on stderr");
}

// Options that give keys of the scene other values.

namespace {

// Adds an option that stands for a key of the scene.
void add_key(CLI::App& verb, Assignments& sets, const char* flag, const char* key, const char* type,
             const std::string& about) {
    verb.add_option_function<std::string>(
            flag,
            [&sets, flag, key](const std::string& value) {
                sets.push_back({fmt::format("{}={}", key, value), flag});
            },
            about)
        ->type_name(type);
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

void add_purpose(CLI::App& verb, Assignments& sets) {
    add_key(verb, sets, "--for", "film.for", "WHAT",
            "Purpose that sets size, rate, format, quality and largest file: " + joined(purpose_names()) +
                " (docs/guide/films.md); values that are set elsewhere stay");
}

// Adds the keys of the film's file.
void add_file_keys(CLI::App& verb, Assignments& sets) {
    add_key(verb, sets, "--format", "film.format", "FORMAT",
            joined(all_of(film_format_words)) + " (docs/guide/films.md) [mp4]");
    add_key(verb, sets, "--max-size", "film.max_size", "SIZE",
            "Largest size of the file, as in 10MB; for mp4, webm and gif");
    add_key(verb, sets, "--sheet", "film.sheet", "CxR",
            "Make sheet.png too, a contact sheet of C columns and R rows");
}

void add_transparent(CLI::App& verb, Assignments& sets) {
    verb.add_flag_callback(
        "--transparent",
        [&sets] {
            sets.push_back({"film.transparent=true", "--transparent"});
        },
        "Make the background transparent; for png and ffv1");
}

// Keys of a film's file and pace, which do not apply to a single picture.
constexpr std::array of_film_file = {"film.format",   "film.quality", "film.preset",
                                     "film.max_size", "film.sheet",   "film.rate"};

}  // namespace

Assignments sets_for_still(Assignments sets, const char* option) {
    bool clear = false;
    for (const Assignment& set : sets) {
        if (contains(of_film_file, set.key()))
            throw UserError("{}: is of a film, and {} draws one PNG file; leave it out", set.place(), option);
        clear = clear || set.key() == "film.transparent";
    }
    if (!clear) return sets;
    sets.push_back({"film.format=png", option});
    sets.push_back({"film.max_size=none", option});
    return sets;
}

void add_sets(CLI::App& verb, Assignments& sets, const char* about) {
    verb.add_option_function<std::vector<std::string>>(
            "--set",
            [&sets](const std::vector<std::string>& values) {
                sets.insert(sets.end(), values.begin(), values.end());
            },
            about)
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
}

namespace {

constexpr const char* about_title = "Title on the film [that of the scene]";
constexpr const char* about_threads = "Processors to keep busy [as many as there are]";

}  // namespace

void add_picture_keys(CLI::App& verb, Assignments& sets) {
    add_purpose(verb, sets);
    add_file_keys(verb, sets);
    add_transparent(verb, sets);
    add_key(verb, sets, "--size", "film.size", "WxH",
            "Size of the film in pixels [the scene's, or 1920x1080]");
    add_key(verb, sets, "--fps", "film.rate", "N", "Frames a second of film [the scene's, or 30]");
    add_key(verb, sets, "--length", "film.length", "TIME", "Length of the film, as in 30s [the scene's]");
    add_key(verb, sets, "--title", "film.title", "TEXT", about_title);
    add_key(verb, sets, "--threads", "run.threads", "N", about_threads);
}

void add_still_keys(CLI::App& verb, Assignments& sets) {
    add_key(verb, sets, "--for", "film.for", "WHAT",
            "With --png: purpose whose size the picture gets: " + joined(purpose_names()));
    add_transparent(verb, sets);
    add_key(verb, sets, "--size", "film.size", "WxH",
            "Size of the picture in pixels [the scene's, or 1920x1080]");
    add_key(verb, sets, "--title", "film.title", "TEXT", about_title);
    add_key(verb, sets, "--threads", "run.threads", "N", about_threads);
}

void add_scene_keys(CLI::App& verb, Assignments& sets) {
    add_sets(verb, sets,
             "Give a key of the scene another value, as in --set drive.frequency=\"25 Hz\"; may be repeated");
    add_picture_keys(verb, sets);
    add_key(verb, sets, "--duration", "run.duration", "TIME", "Simulated time of vibration, as in 10s");
    add_key(verb, sets, "--seed", "run.seed", "N", "Seed of all random choices [1]");
}

void add_scene(CLI::App& verb, std::filesystem::path& scene, Assignments& sets) {
    verb.add_option("SCENE", scene, "The scene, a TOML file; docs/reference/scenes.md lists its keys")
        ->required()
        ->type_name("FILE");
    add_scene_keys(verb, sets);
}

// Options that say where a run is shown live.

namespace {

constexpr int highest_port = 65535;

int port_of(const std::string& flag, const std::string& text) {
    int port = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size() || port < 0 || port > highest_port)
        throw UserError("{} {}: is no port; give a number from 0 (any that is free) to {}", flag,
                        excerpt(text), highest_port);
    return port;
}

}  // namespace

void add_watch_port(CLI::App& verb, WatchPlace& place) {
    verb.add_option_function<std::string>(
            "--port", [&place](const std::string& text) { place.port = port_of("--port", text); },
            fmt::format("Port of the page; 0 takes a free one [{}, or a free one]", kUsualWatchPort))
        ->type_name("N");
}

void add_watch_host(CLI::App& verb, WatchPlace& place) {
    add_typed(verb, "--watch-host", place.host,
              "Name or address of this machine under which other machines may see the page. The address\n"
              "that is printed has a key for one visitor [127.0.0.1: only this machine]",
              "HOST");
}

void add_watch(CLI::App& verb, bool& wanted, WatchPlace& place) {
    verb.add_option_function<std::string>(
            "--watch",
            [&wanted, &place](const std::string& text) {
                if (!text.empty()) place.port = port_of("--watch", text);
                wanted = true;
            },
            "Show the run while it goes, as a page on this machine: picture, bed, charts, time left")
        ->type_name("PORT")
        ->expected(0, 1);
    add_watch_host(verb, place);
}

}  // namespace grainreel
