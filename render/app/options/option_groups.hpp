// Groups of options that several verbs have. Each adds its options to a verb's parser and keeps what they say
// in what it is given.
#pragma once

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/messages/reporter.hpp"
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

// What an option needs that names a file: an unset variable of a shell is no name.
CLI::Validator not_empty();

// --set, of values that are to take the place of others.
void add_sets(CLI::App& verb, Assignments& sets, const char* about);
// The film: --for, --format, --max-size, --sheet, --transparent, --size, --fps, --title; and --threads.
void add_picture_keys(CLI::App& verb, Assignments& sets);
// --set, those of the film, --duration and --seed.
void add_scene_keys(CLI::App& verb, Assignments& sets);
// The settings for a single picture: it is a PNG file, whatever the scene's film is. Throws UserError for
// keys of a film's file.
Assignments sets_for_still(Assignments sets);
// SCENE, and those of its keys.
void add_scene(CLI::App& verb, std::filesystem::path& scene, Assignments& sets);

// Where the film goes, and what is kept of it: --out, --force, --frames, --no-film, --gl. about_out: of
// --out. Throws UserError when the environment has a value that makes no sense.
void add_film(CLI::App& verb, FilmRequest& film, const std::string& about_out);
// --out of a verb that makes no film.
void add_out_folder(CLI::App& verb, std::optional<std::filesystem::path>& out, const std::string& about);
// --gl: what makes OpenGL contexts.
void add_gl(CLI::App& verb, gl::Provider& provider);
// Where what a verb makes goes without --out: $GRAINREEL_OUTPUT, else output/.
std::filesystem::path output_base();

// --dpi and --width-mm: one picture for print.
void add_print_size(CLI::App& verb, PrintSize& print);
// Throws UserError where they are given for more than one. moment: the options that ask for one picture.
void check_print_size(const PrintSize& print, bool one_picture, const char* moment);
// --no-cache, of a verb that runs scenes: packings are neither taken from the user's cache folder nor kept
// there. shortest: s, of packings that are kept; none once that is said, by the option or by
// GRAINREEL_PACKINGS=off; 0 with GRAINREEL_PACKINGS=all. Throws UserError for another value.
CLI::Option* add_no_cache(CLI::App& verb, std::optional<double>& shortest);

// An option that is a time of a finished run, s.
CLI::Option* add_time(CLI::App& verb, const char* flag, std::optional<double>& into, const char* about);

// --no-replay: of finished runs nothing is brought back that they did not keep.
void add_no_replay(CLI::App& verb, bool& replay);

// --port and --watch-host: where a run is shown live.
void add_watch_port(CLI::App& verb, WatchPlace& place);
void add_watch_host(CLI::App& verb, WatchPlace& place);
// --watch, with a port, and --watch-host.
void add_watch(CLI::App& verb, bool& wanted, WatchPlace& place);

// --progress, --quiet and --verbose.
void add_reporting(CLI::App& verb, ReporterOptions& report);

// A list of things with a name and what they are about: the names, and all of it in a line.
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

// CLI::Range lets "nan" through.
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

// A camera can be kept as a file and used again on other runs. The file is the keys of [film.camera] of a
// scene, a line each: azimuth = 20. Lengths are in m, angles in degrees.

struct CameraFiles {
    std::optional<std::filesystem::path> use, keep;
};

// --camera, and --keep-camera with `keep`.
void add_camera_file(CLI::App& verb, CameraFiles& files, bool keep = true);

// The file's keys come before what was set on the command line. Throws UserError with its line for what is no
// key of a camera.
void use_camera_file(const CameraFiles& files, Assignments& sets);

// Writes the camera that pictures are drawn with. Throws UserError where the file is there, RunError where it
// cannot be written.
void keep_camera_file(const CameraFiles& files, const Camera& camera);

// Charts for print: --charts, --as, --width-mm and --dpi.

struct PaperOptions {
    std::optional<std::filesystem::path> folder;  // none: no charts are wanted
    Paper paper;
};

// Gives --charts, which the other options need. about: of --charts.
CLI::Option* add_paper(CLI::App& verb, PaperOptions& options, const char* about);

// Throws UserError where the folder of charts is a file, and where there would be too many pixels.
void check_paper(const PaperOptions& options);

// A film drawn in parts: the options of `render`, and the script by which a cluster draws and joins them.

// --part, --parts and --slurm. slurm: the number of parts; 0: no script.
void add_parts(CLI::App& verb, std::optional<PartsWanted>& parts, int& slurm);

// A script that submits itself to Slurm twice: as an array that draws a part in each task, and as a job that
// waits for the array and joins its parts. words: the command as typed, its program first; where: the folder
// that it was typed in; film: the file of --out.
std::string slurm_script(const std::vector<std::string>& words, int parts, const std::filesystem::path& where,
                         const std::filesystem::path& film);

}  // namespace grainreel
