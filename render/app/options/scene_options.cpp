// Options that give keys of the scene another value.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"

namespace grainreel {

namespace {

// An option that stands for a key of the scene.
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

// Adds the keys of the film's file.
void add_file_keys(CLI::App& verb, Assignments& sets) {
    add_key(verb, sets, "--for", "film.for", "WHAT",
            "Defaults of size, rate, format, quality and cap for " + joined(purpose_names()) +
                " (docs/guide/films.md); what is set elsewhere wins");
    add_key(verb, sets, "--format", "film.format", "FORMAT",
            joined(all_of(film_format_words)) + " (docs/guide/films.md) [mp4]");
    add_key(verb, sets, "--max-size", "film.max_size", "SIZE",
            "Largest file, as in 10MB; of mp4, webm and gif");
    add_key(verb, sets, "--sheet", "film.sheet", "CxR",
            "A contact sheet of so many columns and rows too, sheet.png");
    verb.add_flag_callback(
        "--transparent",
        [&sets] {
            sets.push_back({"film.transparent=true", "--transparent"});
        },
        "Alpha in place of the background; of png and ffv1");
}

// Keys of a film's file and pace, which a single picture does not have.
constexpr std::array of_film_file = {"film.format",   "film.quality", "film.preset",
                                     "film.max_size", "film.sheet",   "film.rate"};

}  // namespace

Assignments sets_for_still(Assignments sets) {
    bool clear = false;
    for (const Assignment& set : sets) {
        if (std::find(of_film_file.begin(), of_film_file.end(), set.key()) != of_film_file.end())
            throw UserError(
                fmt::format("{}: is of a film, and --at draws one PNG file; leave it out", set.place()));
        clear = clear || set.key() == "film.transparent";
    }
    if (!clear) return sets;
    sets.push_back({"film.format=png", "--at"});
    sets.push_back({"film.max_size=none", "--at"});
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

void add_picture_keys(CLI::App& verb, Assignments& sets) {
    add_file_keys(verb, sets);
    add_key(verb, sets, "--size", "film.size", "WxH",
            "Size of the film in pixels [the scene's, or 1920x1080]");
    add_key(verb, sets, "--fps", "film.rate", "N", "Frames a second of film [the scene's, or 30]");
    add_key(verb, sets, "--title", "film.title", "TEXT", "Title on the film [that of the scene]");
    add_key(verb, sets, "--threads", "run.threads", "N", "Processors to keep busy [as many as there are]");
}

void add_scene_keys(CLI::App& verb, Assignments& sets) {
    add_sets(verb, sets,
             "Give a key of the scene another value, as in --set drive.frequency=\"25 Hz\"; may be repeated");
    add_picture_keys(verb, sets);
    add_key(verb, sets, "--duration", "run.duration", "TIME", "Simulated time of vibration, as in 10s");
    add_key(verb, sets, "--seed", "run.seed", "N", "Of every random choice [1]");
}

void add_scene(CLI::App& verb, std::filesystem::path& scene, Assignments& sets) {
    verb.add_option("SCENE", scene, "The scene, a TOML file; docs/reference/scenes.md lists its keys")
        ->required()
        ->type_name("FILE");
    add_scene_keys(verb, sets);
}

}  // namespace grainreel
