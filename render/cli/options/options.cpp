#include "render/cli/options/options.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/chart/chart.hpp"
#include "engine/scene/film/purposes.hpp"
#include "engine/scene/text/units.hpp"
#include "engine/scene/text/words.hpp"
#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/report/version.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_of_a_mistake = 300;  // characters of what CLI11 says

// A word as the shell would need it typed.
std::string quoted(const std::string& word) {
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

gl::Provider provider_of(const std::string& word, const std::string& said_by) {
    if (word == "osmesa") return gl::Provider::osmesa;
    if (word == "egl") return gl::Provider::egl;
    throw UserError(
        fmt::format("{}={}: no such maker of OpenGL contexts; choose osmesa or egl", said_by, excerpt(word)));
}

void add_gl(CLI::App& verb, Options& options) {
    verb.add_option_function<std::string>(
            "--gl", [&options](const std::string& word) { options.gl = provider_of(word, "--gl"); },
            "Draw with osmesa (software, the same everywhere) or egl (a graphics card where there is one)\n"
            "[$GRAINREEL_GL, else osmesa]")
        ->type_name("WHICH");
}

// An option that stands for a key of the scene.
void add_key(CLI::App& verb, Options& options, const char* flag, const char* key, const char* type,
             const std::string& about) {
    verb.add_option_function<std::string>(
            flag,
            [&options, flag, key](const std::string& value) {
                options.sets.push_back({fmt::format("{}={}", key, value), flag});
            },
            about)
        ->type_name(type);
}

void add_sets(CLI::App& verb, Options& options, const char* about) {
    verb.add_option_function<std::vector<std::string>>(
            "--set",
            [&options](const std::vector<std::string>& values) {
                options.sets.insert(options.sets.end(), values.begin(), values.end());
            },
            about)
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

// Of the film's file.
void add_file_keys(CLI::App& verb, Options& options) {
    add_key(verb, options, "--for", "film.for", "WHAT",
            "Defaults of size, rate, format, quality and cap for " + joined(purpose_names()) +
                " (docs/guide/films.md); what is set elsewhere wins");
    add_key(verb, options, "--format", "film.format", "FORMAT",
            joined(all_of(film_format_words)) + " (docs/guide/films.md) [mp4]");
    add_key(verb, options, "--max-size", "film.max_size", "SIZE",
            "Largest file, as in 10MB; of mp4, webm and gif");
    add_key(verb, options, "--sheet", "film.sheet", "CxR",
            "A contact sheet of so many columns and rows too, sheet.png");
    verb.add_flag_callback(
        "--transparent",
        [&options] {
            options.sets.push_back({"film.transparent=true", "--transparent"});
        },
        "Alpha in place of the background; of png and ffv1");
}

void add_picture_keys(CLI::App& verb, Options& options) {
    add_file_keys(verb, options);
    add_key(verb, options, "--size", "film.size", "WxH",
            "Size of the film in pixels [the scene's, or 1920x1080]");
    add_key(verb, options, "--fps", "film.rate", "N", "Frames a second of film [the scene's, or 30]");
    add_key(verb, options, "--title", "film.title", "TEXT", "Title on the film [that of the scene]");
    add_key(verb, options, "--threads", "run.threads", "N", "Processors to keep busy [as many as there are]");
}

void add_scene_keys(CLI::App& verb, Options& options) {
    add_sets(verb, options,
             "Give a key of the scene another value, as in --set drive.frequency=\"25 Hz\"; may be repeated");
    add_picture_keys(verb, options);
    add_key(verb, options, "--duration", "run.duration", "TIME", "Simulated time of vibration, as in 10s");
    add_key(verb, options, "--seed", "run.seed", "N", "Of every random choice [1]");
}

void add_scene(CLI::App& verb, Options& options) {
    verb.add_option("SCENE", options.scene, "The scene, a TOML file; docs/reference/scenes.md lists its keys")
        ->required()
        ->type_name("FILE");
    add_scene_keys(verb, options);
}

constexpr const char* exit_statuses =
    "Exit status: 0 done, 1 the run failed, 2 a mistake in the scene or the options, 129 the\n"
    "terminal was closed (SIGHUP), 130 Ctrl-C, 143 SIGTERM.";

// Where the film goes, and what is kept of it.
void add_film(CLI::App& verb, Options& options, const std::string& about_out) {
    const auto take_out = [&options](const std::string& folder) {
        options.to_stdout = folder == "-";
        if (!options.to_stdout) options.out = folder;
    };
    CLI::Option* out =
        verb.add_option_function<std::string>("--out", take_out,
                                              about_out + "; - puts the film on\nstdout, with --format y4m")
            ->type_name("DIR");
    verb.add_flag("--force", options.force, "Replace the run in --out, once the new one is complete")
        ->needs(out);
    verb.add_flag("--frames", options.frames, "Keep every frame of the film as frames/*.png too");
    verb.add_flag_callback(
        "--no-film", [&options] { options.film = false; },
        "Leave out the film; with --frames, keep the pictures alone");
    add_gl(verb, options);
}

void add_movie(CLI::App& app, Options& options) {
    CLI::App& movie = *app.add_subcommand("movie", "Run a scene and make its film");
    add_scene(movie, options);
    add_film(movie, options, "Folder of the run [output/ and the scene's name, numbered when that is taken]");
    add_reporting(movie, options);
    movie.footer(
        std::string(
            "The folder of the run goes to stdout, everything else to stderr. Ctrl-C ends the film so "
            "that it\nplays and keeps the end state; a second one keeps the end state alone, a third stops "
            "at once.\n") +
        exit_statuses);
    movie.callback([&options] { options.verb = Options::Verb::movie; });
}

// An option that is a time of a finished run.
CLI::Option* add_time(CLI::App& verb, const char* flag, std::optional<double>& into, const char* about) {
    return verb
        .add_option_function<std::string>(
            flag,
            [flag, &into](const std::string& text) {
                try {
                    const bool bare = text.find_first_not_of("0123456789.eE+-") == std::string::npos;
                    into = parse_quantity(bare ? text + " s" : text, Dimension::time);
                } catch (const UserError& mistake) {
                    throw UserError(fmt::format("{} {}", flag, mistake.what()));
                }
            },
            about)
        ->type_name("TIME");
}

void add_render(CLI::App& app, Options& options) {
    CLI::App& render = *app.add_subcommand("render", "Draw a finished run again, without running it");
    RenderRequest& request = options.render;
    render.add_option("RUN", request.run, "Folder of a run, with its scene.toml and trajectory.nc")
        ->required()
        ->type_name("DIR");
    add_sets(render, options,
             "Another value for a key of [film] or a species' colour, as in --set film.camera.azimuth=60 or "
             "--set species.big.colour=orange; may be repeated");
    add_picture_keys(render, options);
    CLI::Option* from = add_time(render, "--from", request.from, "First moment to draw [the run's first]");
    CLI::Option* to = add_time(render, "--to", request.to, "Last moment to draw [the run's last]");
    CLI::Option* every =
        render.add_option("--every", request.every, "Draw one of so many frames of the trajectory [1]")
            ->check(CLI::Range(1, 1000000000))
            ->type_name("N");
    CLI::Option* at =
        add_time(render, "--at", request.at, "Draw the frame nearest to this moment alone, to a PNG file");
    add_film(render, options,
             "Folder of the film [beside RUN, its name with -render]; with --at, the PNG file [beside RUN]");
    for (CLI::Option* other :
         {from, to, every, render.get_option("--frames"), render.get_option("--no-film")})
        at->excludes(other);
    add_reporting(render, options);
    render.footer(
        std::string("RUN itself is never changed. The folder or file that was made goes to stdout.\n") +
        exit_statuses);
    render.callback([&options] { options.verb = Options::Verb::render; });
}

void add_compare(CLI::App& app, Options& options) {
    CLI::App& compare = *app.add_subcommand("compare", "Run scenes and film them side by side, in step");
    compare
        .add_option("SCENE", options.compare.inputs,
                    "Two to six scenes to run, or folders of finished runs to draw from")
        ->required()
        ->type_name("FILE|DIR");
    compare
        .add_option_function<std::string>(
            "--captions",
            [&options](const std::string& text) {
                if (const std::string wrong = complaint_of_utf8(text); !wrong.empty())
                    throw UserError(fmt::format("--captions: {}; type it in a UTF-8 terminal", wrong));
                options.compare.captions = text;
            },
            "One a panel, bars between them, as in \"Γ = 1|Γ = 3\" [what differs: the drives, else the "
            "titles]")
        ->type_name("TEXT");
    add_scene_keys(compare, options);
    add_film(compare, options,
             "Folder of the film, with one in it for each run [output/ and the scenes' names]");
    add_reporting(compare, options);
    compare.footer(
        std::string(
            "Rate, size and segments of the film are those of the first scene; --set and its like go to\n"
            "every scene. All panels show the same moment, at the same scale where they can.\n") +
        exit_statuses);
    compare.callback([&options] { options.verb = Options::Verb::compare; });
}

void add_check(CLI::App& app, Options& options) {
    CLI::App& check =
        *app.add_subcommand("check", "Read a scene and print the plan: laws, stiffness, step, cost");
    add_scene(check, options);
    check.footer("Exit status: 0 the scene can be run, 2 a mistake in it or in the options.");
    check.callback([&options] { options.verb = Options::Verb::check; });
}

void add_chart(CLI::App& app, Options& options) {
    CLI::App& verb = *app.add_subcommand("chart", "Measure the methods themselves: errors, costs, limits");
    const Choices all(charts());
    verb.add_option("CHART", options.chart, all.about)
        ->required()
        ->check(CLI::IsMember(all.names))
        ->type_name("WHICH");
    verb.add_option_function<std::string>(
            "--out", [&options](const std::string& folder) { options.out = folder; },
            "Folder of the tables and pictures; a chart that was stopped there goes on [output/WHICH]")
        ->type_name("DIR");
    verb.add_flag("--quick", options.quick, "Coarser, in a few minutes");
    add_reporting(verb, options);
    verb.footer(
        "Tables (CSV) and the pictures that gnuplot makes of them (SVG, PNG). Ctrl-C stops; the same\n"
        "command goes on.\n"
        "Exit status: 0 done, 1 a measurement failed, 2 a mistake in the options, 130 Ctrl-C, 143 SIGTERM.");
    verb.callback([&options] { options.verb = Options::Verb::chart; });
}

}  // namespace

namespace {

void check_verb(CLI::App& app, const std::string& word) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        verbs.push_back(verb->get_name());
    if (word[0] == '-' || std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return;
    throw UserError(
        fmt::format("{}; there are {}; see grainreel --help",
                    word.empty() ? "no command" : fmt::format("unknown command '{}'", excerpt(word)),
                    fmt::join(verbs, ", ")));
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
    Options options;
    for (int i = 0; i < argc; ++i) options.command += (i == 0 ? "" : " ") + quoted(argv[i]);
    if (const char* base = std::getenv("GRAINREEL_OUTPUT"); base != nullptr && *base != '\0')
        options.base = base;
    if (const char* word = std::getenv("GRAINREEL_GL"); word != nullptr && *word != '\0')
        options.gl = provider_of(word, "GRAINREEL_GL");

    CLI::App app("One scene file becomes a film of vibrated grains and the numbers behind it.", "grainreel");
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text());
    app.get_formatter()->column_width(28);
    app.footer(
        "Begin with:  grainreel movie scenes/wedge_segregation.toml\n"
        "More about a verb:  grainreel movie --help");
    add_movie(app, options);
    add_render(app, options);
    add_compare(app, options);
    add_check(app, options);
    add_chart(app, options);
    add_bench(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        std::ostringstream text;
        app.exit(help, text, text);
        print_result(text.str());
        return std::nullopt;
    } catch (const CLI::ParseError& mistake) {
        check_verb(app, argc > 1 ? argv[1] : "");
        throw UserError(fmt::format("{}; see grainreel --help", excerpt(mistake.what(), most_of_a_mistake)));
    }
    return options;
}

}  // namespace grainreel
