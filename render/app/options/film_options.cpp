// Options that say where a film goes and how it is drawn, with defaults from environment variables.

#include <fmt/format.h>
#include <cstdlib>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/options/option_groups.hpp"

namespace grainreel {

namespace {

// The value of an environment variable; none when it is unset or empty.
std::optional<std::string> variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' ? std::optional<std::string>(value) : std::nullopt;
}

gl::Provider provider_of(const std::string& word, const std::string& said_by) {
    if (word == "osmesa") return gl::Provider::osmesa;
    if (word == "egl") return gl::Provider::egl;
    throw UserError("{}={}: no such maker of OpenGL contexts; choose osmesa or egl", said_by, excerpt(word));
}

}  // namespace

void add_gl(CLI::App& verb, gl::Provider& provider) {
    if (const auto word = variable("GRAINREEL_GL")) provider = provider_of(*word, "GRAINREEL_GL");
    verb.add_option_function<std::string>(
            "--gl", [&provider](const std::string& word) { provider = provider_of(word, "--gl"); },
            "Draw with osmesa (software, the same everywhere) or egl (a graphics card where there is one)\n"
            "[$GRAINREEL_GL, else osmesa]")
        ->type_name("WHICH");
}

CLI::Validator not_empty() {
    return CLI::Validator([](std::string& text) { return text.empty() ? "is empty; give a name" : ""; }, "");
}

void check_typed(const std::string& option, const std::string& text) {
    if (const std::string wrong = complaint_of_utf8(text); !wrong.empty())
        throw UserError("{}: {}; type it in a UTF-8 terminal", option, wrong);
}

std::filesystem::path output_base() {
    const std::string base = variable("GRAINREEL_OUTPUT").value_or("output");
    check_typed("GRAINREEL_OUTPUT", base);
    return base;
}

void check_folder_name(const std::filesystem::path& out) {
    if (is_folder(out)) return;
    const std::string end = out.extension().string();
    for (const char* one : {".png", ".mp4", ".webm", ".mkv", ".gif", ".y4m", ".pdf"})
        if (end == one)
            throw UserError("--out {}: names the folder, in which the files are made; give a name without {}",
                            out.string(), end);
}

void add_out_folder(CLI::App& verb, std::optional<std::filesystem::path>& out, const std::string& about) {
    add_typed(verb, "--out", out, about, "DIR");
}

void add_print_size(CLI::App& verb, PrintSize& print) {
    constexpr double most = 1e5;
    verb.add_option("--dpi", print.dpi,
                    "With --at: pixels an inch, stored in the file for print [300 with --width-mm or --pdf]")
        ->check(number_within(1, most))
        ->type_name("N");
    verb.add_option("--width-mm", print.width_mm,
                    "With --at: width on paper; the picture gets the pixels that this needs")
        ->check(number_within(1, most))
        ->type_name("MM");
    verb.add_flag("--pdf", print.pdf,
                  "With --at: make a PDF, with the picture at --dpi and its words as text");
}

void check_print_size(const PrintSize& print, bool one_picture, const char* moment) {
    if (!one_picture && print.wanted())
        throw UserError("{}: is for one picture; add {}",
                        print.pdf   ? "--pdf"
                        : print.dpi ? "--dpi"
                                    : "--width-mm",
                        moment);
}

void add_film(CLI::App& verb, FilmRequest& film, const std::string& about_out) {
    film.base = output_base();
    const auto take_out = [&film](const std::string& folder) {
        check_typed("--out", folder);
        film.to_stdout = folder == "-";
        if (!film.to_stdout) film.out = folder;
    };
    CLI::Option* out =
        verb.add_option_function<std::string>("--out", take_out,
                                              about_out + "; - writes the film to\nstdout, with --format y4m")
            ->type_name("DIR");
    verb.add_flag("--force", film.force, "Replace the run in --out, once the new one is complete")
        ->needs(out);
    verb.add_flag("--frames", film.frames, "Keep every frame of the film as frames/*.png too");
    verb.add_flag_callback(
        "--no-film", [&film] { film.film = false; },
        "Leave out the film; with --frames, keep only the pictures");
    add_gl(verb, film.gl);
}

CLI::Option* add_no_cache(CLI::App& verb, std::optional<double>& shortest) {
    constexpr double worth_a_file = 1;  // s; a packing that took less is not kept
    shortest = worth_a_file;
    if (const auto word = variable("GRAINREEL_PACKINGS")) {
        if (*word != "off" && *word != "all")
            throw UserError("GRAINREEL_PACKINGS={}: is neither off nor all", excerpt(*word));
        shortest = *word == "all" ? std::optional(0.0) : std::nullopt;
    }
    return verb.add_flag_callback(
        "--no-cache", [&shortest] { shortest.reset(); },
        "Pack anew and do not keep the packing. Otherwise a packing that took longer than a second is "
        "kept\n"
        "in the user's cache folder; later runs with the same start use it and have the same bits\n"
        "[$GRAINREEL_PACKINGS]");
}

CLI::Option* add_time(CLI::App& verb, const char* flag, std::optional<double>& into, const char* about) {
    return verb
        .add_option_function<std::string>(
            flag,
            [flag, &into](const std::string& text) {
                try {
                    const bool bare = text.find_first_not_of("0123456789.eE+-") == std::string::npos;
                    into = parse_quantity(bare ? text + " s" : text, Dimension::time);
                } catch (const UserError& mistake) {
                    throw UserError("{} {}", flag, mistake.what());
                }
            },
            about)
        ->type_name("TIME");
}

void add_no_replay(CLI::App& verb, bool& replay) {
    verb.add_flag_callback(
        "--no-replay", [&replay] { replay = false; },
        "Draw only what finished runs kept, and say what is left out. Otherwise moments that they did not\n"
        "keep are brought back from their checkpoints");
}

namespace {

namespace fs = std::filesystem;

std::string triple(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

}  // namespace

void add_camera_file(CLI::App& verb, CameraFiles& files, CameraOptions which) {
    add_typed(verb, "--camera", files.use, "Take the camera from this file, which --keep-camera wrote",
              "FILE")
        ->check(not_empty());
    if (which == CameraOptions::use_and_keep)
        add_typed(verb, "--keep-camera", files.keep,
                  "Write the camera to a file, for --camera with other runs", "FILE")
            ->check(not_empty());
}

void use_camera_file(const CameraFiles& files, Assignments& sets) {
    if (!files.use) return;
    std::ifstream in = read_plain(*files.use);
    if (!in) throw UserError("--camera {}: cannot be opened; is there such a file?", files.use->string());
    constexpr int most_lines = 100;
    Assignments all;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        const std::string place = fmt::format("{}:{}", files.use->string(), ++number);
        if (number > most_lines) throw UserError("{}: is no file of a camera, which has few lines", place);
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty() || line == "[film.camera]") continue;
        const std::size_t equals = line.find('=');
        const std::string key(trimmed(line.substr(0, equals)));
        const bool plain = equals != std::string::npos && !key.empty() &&
                           key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
        if (!plain)
            throw UserError("{}: '{}' is no key of a camera; a line is like: azimuth = 20", place,
                            excerpt(line));
        all.push_back({fmt::format("film.camera.{}={}", key, trimmed(line.substr(equals + 1))), place});
    }
    if (all.empty()) throw UserError("--camera {}: has no key of a camera", files.use->string());
    all.insert(all.end(), sets.begin(), sets.end());
    sets = std::move(all);
}

void keep_camera_file(const CameraFiles& files, const Camera& camera) {
    if (!files.keep) return;
    if (is_there(*files.keep))
        throw UserError("--keep-camera {}: exists already; choose another name", files.keep->string());
    check_folder_around(*files.keep, "--keep-camera " + files.keep->string());
    if (!camera.keys.empty())
        throw UserError(
            "--keep-camera: the camera moves by [[film.camera.key]], which no file of one camera holds");
    std::string text = "# A camera by grainreel: render RUN --camera THIS_FILE\n[film.camera]\n";
    if (camera.position) {
        text += fmt::format("position = {}\n", triple(*camera.position));
    } else {
        const char* frames[] = {"container", "bed", "reach"};
        text += fmt::format("azimuth = {}\nelevation = {}\nframe = \"{}\"\n", camera.azimuth,
                            camera.elevation, frames[static_cast<int>(camera.frame)]);
        if (camera.frame == FramingScope::reach && camera.reach)
            text += fmt::format("reach = {}\n", *camera.reach);
    }
    if (camera.target) text += fmt::format("target = {}\n", triple(*camera.target));
    text += fmt::format("field_of_view = {}\nzoom = {}\nup = {}\nfollow = {}\n", camera.field_of_view,
                        camera.zoom, triple(camera.up), camera.follow);
    TextFile(*files.keep).write(text);
}

}  // namespace grainreel
