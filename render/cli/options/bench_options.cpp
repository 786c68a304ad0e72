#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "engine/base/error.hpp"
#include "engine/scene/film/colours.hpp"
#include "render/cli/options/option_groups.hpp"

namespace grainreel {
namespace {

void read_bench_size(const std::string& size, Film& film) {
    int end = 0;
    const bool read = std::sscanf(size.c_str(), "%dx%d%n", &film.width, &film.height, &end) == 2;
    if (!read || end != static_cast<int>(size.size()) || std::min(film.width, film.height) < 64 ||
        std::max(film.width, film.height) > 8192)
        throw UserError(
            fmt::format("--size {}: must be width x height, each from 64 to 8192, as in 1920x1080", size));
}

void set_bench_style(const std::string& style, BenchRenderRequest& request) {
    request.style = style;
    Film& film = request.film;
    const bool bare = style == "plain" || style == "flat";
    film.look.occlusion = film.look.shadows = film.look.ground = !bare;
    film.look.style = style == "flat"   ? FilmLook::Style::flat
                      : style == "dark" ? FilmLook::Style::dark
                                        : FilmLook::Style::studio;
    film.background = default_background(film.look.style);
}

}  // namespace

void add_bench(CLI::App& app, Options& options) {
    CLI::App& verb = *app.add_subcommand("bench", "Time the engine on a bed of known kind");
    Choices cases(bench_cases());
    cases.add("render", "the drawing of the peers' bed at rest, by stage");
    verb.add_option("CASE", options.bench, cases.about)
        ->required()
        ->check(CLI::IsMember(cases.names))
        ->type_name("CASE");
    verb.add_option("--threads", options.bench_request.threads, "Threads [as many as there are processors]")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    verb.add_option_function<std::string>(
            "--precision",
            [&options](const std::string& word) {
                options.bench_request.precision = word == "mixed" ? Precision::mixed : Precision::full;
            },
            "double or mixed [double]")
        ->check(CLI::IsMember({"double", "mixed"}))
        ->type_name("WHICH");
    verb.add_option("--particles", options.bench_request.particles,
                    "Grains [by the case]; for render: --grains")
        ->check(CLI::Range(100, 10000000))
        ->type_name("N");
    verb.add_option("--repeat", options.bench_request.repeats, "Run it all so often and give medians [1]")
        ->check(CLI::Range(1, 1000))
        ->type_name("K");
    verb.add_option("--grains", options.bench_render.grains, "render: grains in the bed [10125]")
        ->check(CLI::Range(100, 10000000))
        ->type_name("N");
    verb.add_option_function<std::string>(
            "--size",
            [&options](const std::string& size) { read_bench_size(size, options.bench_render.film); },
            "render: of the picture in pixels [1920x1080]")
        ->type_name("WxH");
    verb.add_option_function<std::string>(
            "--out", [&options](const std::string& file) { options.out = file; },
            "render: keep the picture, and the grains and camera for other renderers, in this folder")
        ->type_name("DIR");
    verb.add_option_function<std::string>(
            "--style", [&options](const std::string& style) { set_bench_style(style, options.bench_render); },
            "render: studio, flat, dark or plain (lit spheres alone) [studio]")
        ->check(CLI::IsMember({"studio", "flat", "dark", "plain"}))
        ->type_name("WHICH");
    verb.add_flag_callback(
        "--orthographic", [&options] { options.bench_render.film.camera.field_of_view = 0; },
        "render: with an orthographic camera");
    verb.add_option("--zoom", options.bench_render.film.camera.zoom,
                    "render: closer than where the grains fill the picture's height or width [1]")
        ->type_name("Z")
        ->check(CLI::Range(0.01, 100.0));
    verb.add_flag("--quick", options.bench_request.quick,
                  "A tenth of the steps, to try it: the bed is then\nhardly settled, and its figures are not "
                  "those of a whole run");
    verb.add_flag("--json", options.json, "One JSON object in place of a table");
    add_reporting(verb, options);
    verb.footer(
        "Results go to stdout, progress to stderr.\n"
        "Exit status: 0 done, 1 the run failed, 2 a mistake in the options, 130 Ctrl-C, 143 SIGTERM.");
    verb.callback([&options] { options.verb = Options::Verb::bench; });
}

}  // namespace grainreel
