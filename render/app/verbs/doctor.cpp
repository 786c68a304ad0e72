// The verb `doctor` says what this machine has, what is missing, and how to get it. It checks each thing by
// using it: a context is made, an encoder is opened, a lattice is stepped.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/run/driver/packing_cache.hpp"
#include "engine/run/import/import_run.hpp"
#include "engine/vector/instructions.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/picture/gl/opengl.hpp"
#include "render/picture/words/missing_letters.hpp"
#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

struct Diagnosis {
    std::string what;      // "OpenGL by OSMesa"
    std::string state;     // what was found, or why it was not
    bool good = true;      // it is present and good enough
    bool needed = true;    // without it there are no films; false: only a smaller feature is missing
    std::string remedy{};  // what the user can do when it is not good
};

namespace fs = std::filesystem;

constexpr double gigabyte = 1e9;
constexpr double least_room = 1e9;    // bytes of disk: some films and trajectories
constexpr double least_memory = 5e8;  // bytes: a bed of 100,000 grains and a picture of 1080 lines

std::string speed_text(int threads) {
    return fmt::format("{:.0f} M grain-steps/s", 1e-6 * lattice_speed(threads));
}

Diagnosis opengl(const char* what, gl::Provider provider, const std::string& remedy) {
    Diagnosis finding{what, "", true, false, remedy};
    try {
        finding.state = gl::make_context(provider, 1)->description();
    } catch (const std::exception& problem) {
        finding.state = problem.what();
        finding.good = false;
    }
    return finding;
}

Diagnosis film_format(const std::string& name, FilmFormat format) {
    const Codec& codec = codec_of(format);
    Diagnosis finding{fmt::format("film as {}", name), codec.words, true, false,
                      "install an FFmpeg that has an encoder for " + std::string(codec.standard)};
    CodecSettings settings;
    settings.width = settings.height = 64;
    try {
        finding.state += ", " + open_codec(codec, settings).description;
    } catch (const std::exception& problem) {
        finding.state = problem.what();
        finding.good = false;
    }
    return finding;
}

// "5.1.9 (libavformat 59.27.100, libavcodec 59.37.100, libswscale 6.7.100)"
std::string ffmpeg_text() {
    std::string text, parts;
    for (const auto& [name, version] : ffmpeg_versions()) {
        if (text.empty()) {
            text = version;
            continue;
        }
        parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", name, version);
    }
    return fmt::format("{} ({})", text, parts);
}

std::optional<fs::path> on_the_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "";
    folders += ':';
    for (std::size_t start = 0, end; (end = folders.find(':', start)) != std::string::npos; start = end + 1) {
        const fs::path file = fs::path(folders.substr(start, end - start)) / program;
        if (access(file.c_str(), X_OK) == 0) return file;
    }
    return std::nullopt;
}

// Available memory in bytes, with the caches that the system would give up.
double available_memory() {
    std::ifstream figures("/proc/meminfo");
    std::string name, unit;
    double kibibytes = 0;
    while (figures >> name >> kibibytes) {
        if (name == "MemAvailable:") return 1024 * kibibytes;
        std::getline(figures, unit);
    }
    return 0;
}

// The folder itself, or the nearest one above it that exists.
fs::path existing(fs::path folder) {
    std::error_code error;
    folder = fs::absolute(folder, error);
    while (!is_folder(folder) && folder.has_relative_path()) folder = folder.parent_path();
    return folder;
}

std::vector<Diagnosis> find_processors() {
    const int usable = usable_processors();
    const unsigned all = std::max(1u, std::thread::hardware_concurrency());
    std::string speed = speed_text(1) + " on one thread";
    if (usable > 1) speed += fmt::format(", {} on {}", speed_text(usable), usable);
    return {{"processors", fmt::format("{} usable of {}", usable, all)},
            {"vectors", vector_instructions()},
            {"engine's speed", speed + " (a lattice of 1,728 grains)"}};
}

std::vector<Diagnosis> find_drawing() {
    std::vector<Diagnosis> found = {
        opengl("OpenGL by OSMesa", gl::Provider::osmesa,
               "on Debian 13 and older: apt-get install libosmesa6"),
        opengl("OpenGL by EGL", gl::Provider::egl, "on Debian: apt-get install libegl1 libegl-mesa0")};
    // One of the two is enough, so each is needed only when the other is missing too.
    for (Diagnosis& finding : found) finding.needed = !found[0].good && !found[1].good;
    return found;
}

// FFmpeg and the formats that it makes. Without FFmpeg the formats are left out.
std::vector<Diagnosis> find_films() {
    Diagnosis ffmpeg{"FFmpeg", "", true, true, "without it there are no films, but PNG pictures"};
    try {
        ffmpeg.state = ffmpeg_text();
    } catch (const std::exception& problem) {
        ffmpeg.state = problem.what();
        ffmpeg.good = false;
        return {ffmpeg};
    }
    std::vector<Diagnosis> found = {ffmpeg};
    for (const auto& [word, format] : film_format_words) {
        if (format == FilmFormat::png) continue;  // the format png has no encoder
        found.push_back(film_format(std::string(word), format));
        found.back().needed = format == FilmFormat::mp4;
    }
    return found;
}

// Findings about imports. A full cache is no fault: it makes room by itself.
std::vector<Diagnosis> find_imports() {
    constexpr double megabyte = 1e6;
    const ImportsKept kept = imports_kept();
    const std::string of = kept.folder.string();
    if (!kept.fault.empty())
        return {{"imported files", fmt::format("none: {} {}", of, kept.fault), false, false,
                 "remove it, or set XDG_CACHE_HOME to a folder of yours"}};
    if (kept.imports == 0) return {{"imported files", fmt::format("none in {}", of)}};
    return {{"imported files",
             fmt::format(
                 "{} of other programs, {:.1f} MB in {} (at most {:.0f} MB are kept); to empty it: rm -r {}",
                 kept.imports, static_cast<double>(kept.bytes) / megabyte, of,
                 static_cast<double>(kept.most_bytes) / megabyte, shell_word(of))}};
}

std::vector<Diagnosis> find_packings() {
    constexpr double megabyte = 1e6;
    const PackingsKept kept = packings_kept();
    const std::string of = kept.folder.string();
    if (kept.packings == 0)
        return {{"packings", of.empty() ? "none: there is no cache folder" : fmt::format("none in {}", of)}};
    return {{"packings",
             fmt::format("{} kept for later runs, {:.1f} MB in {} (at most {:.0f} MB are kept); to empty it: "
                         "rm -r {}",
                         kept.packings, static_cast<double>(kept.bytes) / megabyte, of,
                         static_cast<double>(kept.most_bytes) / megabyte, shell_word(of))}};
}

std::vector<Diagnosis> find_programs() {
    Diagnosis gnuplot{"gnuplot", "", true, false, "for charts; on Debian: apt-get install gnuplot-nox"};
    const std::optional<fs::path> file = on_the_path("gnuplot");
    gnuplot.good = file.has_value();
    gnuplot.state = file ? file->string() : "is not on the PATH";
    return {gnuplot};
}

// Findings about fonts: for the letters that words on films always need (Latin and Greek), and for those of
// other scripts.
std::vector<Diagnosis> find_letters() {
    std::vector<std::string> here, absent, packages;
    bool usual = true;
    for (const ScriptSample& sample : script_samples()) {
        const std::vector<MissingLetters> missing = missing_letters(sample.letters);
        (missing.empty() ? here : absent).emplace_back(sample.name);
        if (missing.empty()) continue;
        std::string package = missing.front().package;
        const bool of_ours = std::string(sample.name) == "Latin" || std::string(sample.name) == "Greek";
        if (of_ours) package = "fonts-dejavu-core", usual = false;
        if (!contains(packages, package)) packages.push_back(std::move(package));
    }
    std::vector<Diagnosis> found;
    found.push_back({"letters", here.empty() ? "no font at all" : fmt::format("{}", fmt::join(here, ", ")),
                     usual, true, "on Debian: apt-get install fonts-dejavu-core"});
    if (!absent.empty())
        found.push_back(
            {"letters",
             fmt::format("no font for {}: a film has boxes in their place", fmt::join(absent, ", ")), false,
             false,
             fmt::format("for words on films; on Debian: apt-get install {}", fmt::join(packages, " "))});
    return found;
}

std::vector<Diagnosis> find_room(const fs::path& out) {
    const double memory = available_memory();
    const fs::path folder = existing(out);
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    const double free = error ? 0 : static_cast<double>(space.available);
    const bool writable = access(folder.c_str(), W_OK) == 0;
    return {{"memory", fmt::format("{:.1f} GB free", memory / gigabyte), memory > least_memory, false,
             "end other programs, or run smaller beds"},
            {"disk",
             fmt::format("{:.1f} GB free in {}{}", free / gigabyte, folder.string(),
                         writable ? "" : ", which you may not write to"),
             writable && free > least_room, true, "choose another folder with --out"}};
}

std::string line_of(const Diagnosis& finding, std::size_t width) {
    const char* mark = finding.good ? "ok     " : finding.needed ? "MISSING" : "absent ";
    std::string line = fmt::format("{}  {:<{}}  {}\n", mark, finding.what, width, finding.state);
    if (!finding.good) line += fmt::format("{:{}}{}\n", "", 9 + width + 2, finding.remedy);
    return line;
}

class Doctor final : public Verb {
  public:
    Doctor()
        : Verb("doctor", "Tell what films need, what of it this machine has, and how to get the rest",
               "Exit status: 0 films can be made, 1 something that films need is missing.") {}

    void add_options(CLI::App&) override {}

    int run(Reporter&) override {
        std::vector<Diagnosis> all{{"program", where_program_is(), true, true, ""}};
        for (std::vector<Diagnosis> found :
             {find_processors(), find_room(output_base()), find_drawing(), find_films(), find_letters(),
              find_programs(), find_imports(), find_packings()})
            all.insert(all.end(), found.begin(), found.end());
        std::size_t width = 0;
        for (const Diagnosis& finding : all) width = std::max(width, finding.what.size());
        std::string text;
        for (const Diagnosis& finding : all) text += line_of(finding, width);
        const bool films =
            std::all_of(all.begin(), all.end(), [](const Diagnosis& one) { return one.good || !one.needed; });
        text += films ? "Films can be made here.\n"
                      : "Films cannot be made here before what is MISSING is there.\n";
        print_result(text);
        return films ? 0 : 1;
    }

    bool ends_in_good_order() const override { return false; }
};

}  // namespace

std::unique_ptr<Verb> doctor_verb() {
    return std::make_unique<Doctor>();
}

}  // namespace grainreel
