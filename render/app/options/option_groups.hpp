// Groups of options that several verbs have. Each function adds the options of a group to a verb's parser;
// their values go into the function's other arguments. option_groups.cpp and film_options.cpp have the
// functions.
#pragma once

#include <fmt/format.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/print/paper.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/page/live/watch.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

inline constexpr const char* exit_statuses =
    "Exit status: 0 done, 1 the run failed, 2 a mistake in the scene or the options, 129 the\n"
    "terminal was closed (SIGHUP), 130 Ctrl-C, 143 SIGTERM.";

// Throws UserError when what was typed after an option is not UTF-8.
void check_typed(const std::string& option, const std::string& text);

// An option whose text is checked in that way. type: what help calls its value.
template <class Text>
CLI::Option* add_typed(CLI::App& verb, const char* option, Text& into, const std::string& about,
                       const char* type) {
    const auto take = [option, &into](const std::string& text) {
        check_typed(option, text);
        into = text;
    };
    return verb.add_option_function<std::string>(option, take, about)->type_name(type);
}

// A check for options that name a file: an empty name, as from an unset shell variable, is refused.
CLI::Validator not_empty();

// --set: gives keys of the scene other values.
void add_sets(CLI::App& verb, Assignments& sets, const char* about);
// Keys of the film: --for, --format, --max-size, --sheet, --transparent, --size, --fps, --title; and
// --threads.
void add_picture_keys(CLI::App& verb, Assignments& sets);
// Those of them that act on a single picture: --for, --transparent, --size, --title; and --threads.
void add_still_keys(CLI::App& verb, Assignments& sets);
// --set, the options of add_picture_keys(), --duration and --seed.
void add_scene_keys(CLI::App& verb, Assignments& sets);
// The settings for a single picture, which is a PNG file whatever format the scene's film has. Throws
// UserError for keys of a film's file. option: what asks for the picture, as in "--at".
Assignments sets_for_still(Assignments sets, const char* option = "--at");
// SCENE, and the options of add_scene_keys().
void add_scene(CLI::App& verb, std::filesystem::path& scene, Assignments& sets);

// Where the film goes, and what is kept of it: --out, --force, --frames, --no-film, --gl. about_out: the
// description of --out. Throws UserError when the environment has a value that makes no sense.
void add_film(CLI::App& verb, FilmRequest& film, const std::string& about_out);
// Throws UserError where the name for a folder is that of a film or a picture, and no such folder is there.
void check_folder_name(const std::filesystem::path& out);
// --out of a verb that makes no film.
void add_out_folder(CLI::App& verb, std::optional<std::filesystem::path>& out, const std::string& about);
// --gl: the library that makes OpenGL contexts.
void add_gl(CLI::App& verb, gl::Provider& provider);
// The folder for a verb's results without --out: $GRAINREEL_OUTPUT, else output/.
std::filesystem::path output_base();

// --dpi and --width-mm, for one picture for print.
void add_print_size(CLI::App& verb, PrintSize& print);
// Throws UserError when a print size is given for more than one picture. moment: the options that ask for one
// picture.
void check_print_size(const PrintSize& print, bool one_picture, const char* moment);
// --no-cache, of a verb that runs scenes: packings are neither taken from the user's cache folder nor kept
// there. shortest: packings that took at least this time (s) are kept. The option and GRAINREEL_PACKINGS=off
// empty it, and GRAINREEL_PACKINGS=all makes it 0. Throws UserError for another value of the variable.
CLI::Option* add_no_cache(CLI::App& verb, std::optional<double>& shortest);

// Adds an option that is a time of a finished run in s.
CLI::Option* add_time(CLI::App& verb, const char* flag, std::optional<double>& into, const char* about);

// --no-replay: moments that finished runs did not keep are not brought back.
void add_no_replay(CLI::App& verb, bool& replay);

// --port and --watch-host: where a run is shown live.
void add_watch_port(CLI::App& verb, WatchPlace& place);
void add_watch_host(CLI::App& verb, WatchPlace& place);
// --watch, with a port, and --watch-host.
void add_watch(CLI::App& verb, bool& wanted, WatchPlace& place);

// --progress, --quiet and --verbose.
void add_reporting(CLI::App& verb, ReporterOptions& report);

// The choices of an option: their names, and a line with all names and what they mean.
struct Choices {
    std::vector<std::string> names;
    std::string about;

    template <class All>
    explicit Choices(const All& all) {
        for (const auto& one : all) add(one.name, one.about);
    }
    void add(const std::string& name, const std::string& what) {
        names.push_back(name);
        about += (about.empty() ? "" : "; ") + name + " (" + what + ")";
    }
};

// A check for a number in a range. CLI::Range would accept "nan".
inline CLI::Validator number_within(double low, double high) {
    return CLI::Validator(
        [low, high](const std::string& text) {
            double number = 0;
            const bool good = CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
            return good ? std::string()
                        : fmt::format("must be a number from {} to {}, but is {}", low, high, text);
        },
        "");
}

// A camera can be kept as a file and used again on other runs. The file has the keys of [film.camera] of a
// scene, one in each line: azimuth = 20. Lengths are in m, angles in degrees.

struct CameraFiles {
    std::optional<std::filesystem::path> use, keep;
};

enum class CameraOptions { use, use_and_keep };  // --camera, and also --keep-camera
void add_camera_file(CLI::App& verb, CameraFiles& files, CameraOptions which = CameraOptions::use_and_keep);

// Adds the file's keys; values set on the command line override them. Throws UserError with the line's number
// for anything that is no key of a camera.
void use_camera_file(const CameraFiles& files, Assignments& sets);

// Writes the camera that pictures are drawn with. Throws UserError when the file exists, RunError when it
// cannot be written.
void keep_camera_file(const CameraFiles& files, const Camera& camera);

// Charts for print: --charts, --as, --width-mm and --dpi.

struct PaperOptions {
    std::optional<std::filesystem::path> folder;  // folder of the charts; none: no charts are wanted
    Paper paper;
};

// Returns --charts, which the other options need. about: the description of --charts.
CLI::Option* add_paper(CLI::App& verb, PaperOptions& options, const char* about);

// Throws UserError when the folder of charts is a file, and when there would be too many pixels.
void check_paper(const PaperOptions& options);

// A film drawn in parts: options of `render`, and the script by which a cluster draws and joins the parts.

// --part, --parts and --slurm. slurm: the number of parts; 0: no script.
void add_parts(CLI::App& verb, std::optional<PartsWanted>& parts, int& slurm);

// A script that submits itself to Slurm twice: as an array that draws a part in each task, and as a job that
// waits for the array and joins its parts. words: the command as typed, with its program first. where: the
// folder in which it was typed. film: the file of --out.
std::string slurm_script(const std::vector<std::string>& words, int parts, const std::filesystem::path& where,
                         const std::filesystem::path& film);

}  // namespace grainreel
