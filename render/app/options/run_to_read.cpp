#include "render/app/options/run_to_read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/foreign/names.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/handover/bring_back.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/run/import/import_run.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/option_groups.hpp"

namespace grainreel {

namespace fs = std::filesystem;

fs::path folder_holding(const fs::path& path) {
    if (!is_pattern(path) && is_folder(path)) {
        const fs::path whole = fs::absolute(path).lexically_normal();
        return whole.has_filename() ? whole.parent_path() : whole.parent_path().parent_path();
    }
    return folder_around(path);
}

void bring_back_to_read(const fs::path& path, Reporter& reporter) {
    if (!is_handover(path)) return;
    const ShareWatcher watcher(reporter, Progress::Stage::reading);
    const BroughtBack back =
        bring_back(path, build_info::version, [&](double done) { return watcher("the dump", done); });
    for (const std::string& line : back.news) reporter.warning(line);
}

namespace {

// Throws for a file of which no run can be made. A scene is left to the reader of runs, which knows the verb
// for it.
void refuse_other_files(const fs::path& path) {
    std::error_code ignored;
    if (!is_there(path) || is_folder(path) || path.extension() == ".toml") return;
    const ReadFormat* const reader = reader_of(path);
    if (reader != nullptr)
        throw UserError("{}: is {}; give the folder of its run", path.string(), reader->about);
    for (const ReadFormat& known : frame_readers())
        if (std::string_view(known.name) == "foreign")
            throw UserError(
                "{}: is {}; give the folder of a run, or {}", path.string(),
                fs::file_size(path, ignored) == 0 ? "an empty file" : "a file of no format that is read here",
                known.about);
}

}  // namespace

void refuse_other_folder(const fs::path& path) {
    std::error_code ignored;
    if (!is_folder(path) || is_handover(path) || is_there(path / "scene.toml") ||
        is_there(path / "trajectory.nc"))
        return;
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, ignored))
        if (entry.is_directory(ignored)) inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    std::vector<std::string> runs;
    for (const fs::path& folder : inside)
        if (fs::exists(folder / "scene.toml", ignored)) runs.push_back(folder.string());
    constexpr std::size_t most = 5;
    const std::string more = runs.size() > most ? fmt::format(" and {} more", runs.size() - most) : "";
    if (!runs.empty())
        throw UserError(
            "{}: is no folder of a run; name one of the runs in it: {}{}", path.string(),
            fmt::join(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(std::min(most, runs.size())),
                      ", "),
            more);
    for (const fs::path& folder : inside)
        if (!fs::exists(folder / "film_times.csv", ignored) && is_foreign(folder))
            throw UserError(
                "{}: is no folder of a run; files of another program lie in {}; name "
                "that folder",
                path.string(), folder.string());
}

void check_reading(const fs::path& path, const ReadingOptions& reading) {
    const std::string option = given_reading(reading);
    if (reading.moves_with_container && reading.container.empty())
        throw UserError("--moves-with container: is about the container of a scene; add --container SCENE");
    if (option.empty() || is_foreign(path)) return;
    if (!is_there(path)) throw UserError("{}: there is no such file or folder", path.string());
    refuse_other_files(path);
    refuse_other_folder(path);
    throw UserError("{}: is for files of other programs, and {} {}", option, path.string(),
                    is_there(path / "scene.toml") || path.extension() == ".toml"
                        ? "is ours"
                        : "holds none that can be read");
}

RunToRead run_to_read(const fs::path& path, const ReadingOptions& reading, Reporter& reporter) {
    if (!is_foreign(path)) {
        refuse_other_files(path);
        check_reading(path, reading);
        refuse_other_folder(path);
        bring_back_to_read(path, reporter);
        return {path, path.parent_path(), false};
    }
    ImportRequest request;
    request.from = path;
    request.reading = reading;
    check_reading(path, reading);
    request.program_version = fmt::format("{} ({})", build_info::version, build_info::commit);
    const ShareWatcher watcher(reporter, Progress::Stage::reading);
    request.watcher = [&](double done) { return watcher(path.filename().string(), done); };
    const Imported run = cached_import(request);
    reporter.name_import(run.folder, path);
    for (const std::string& line : run.news) reporter.info(line);
    return {run.folder, folder_holding(path), true, run.news};
}

// Options for files of other programs.

namespace {

using Pair = std::pair<std::string, std::string>;

// Parses pairs such as "a=b,c=d". Throws UserError for another form.
std::vector<Pair> pairs_of(const std::string& option, const std::string& text, const char* example) {
    std::vector<Pair> pairs;
    std::size_t from = 0;
    while (from <= text.size()) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::string one = text.substr(from, to - from);
        const std::size_t equals = one.find('=');
        const std::string name(trimmed(one.substr(0, equals), " \t"));
        const std::string value =
            equals == std::string::npos ? "" : std::string(trimmed(one.substr(equals + 1), " \t"));
        if (name.empty() || value.empty())
            throw UserError("{} {}: '{}' is no pair NAME=VALUE; write it as in {} {}", option, text, one,
                            option, example);
        pairs.emplace_back(name, value);
        from = to + 1;
    }
    return pairs;
}

double positive_quantity(const std::string& option, const std::string& text, Dimension dimension,
                         const char* example) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool plain =
        error == std::errc() && end == text.data() + text.size();  // a plain number is in SI units
    try {
        if (!plain) value = parse_quantity(text, dimension, example);
    } catch (const std::exception& problem) {
        throw UserError("{} {}: {}", option, text, problem.what());
    }
    if (!(value > 0)) throw UserError("{} {}: must be larger than 0, as in {}", option, text, example);
    return value;
}

void set_columns(ReadingOptions& reading, const std::string& text) {
    const std::vector<std::string> known = all_meanings();
    for (const auto& [meaning, column] : pairs_of("--columns", text, "radius=c_rad,type=mol")) {
        if (!contains(known, meaning))
            throw UserError("--columns {}={}: there is no such meaning; there are {}", meaning, column,
                            fmt::join(known, ", "));
        reading.columns[meaning] = column;
    }
}

void set_radius(ReadingOptions& reading, const std::string& text) {
    if (text.find('=') == std::string::npos) {
        reading.radius = positive_quantity("--radius", text, Dimension::length, "2 mm");
        return;
    }
    for (const auto& [type, radius] : pairs_of("--radius", text, "1=2mm,2=5mm"))
        reading.radius_of_type[type] = positive_quantity("--radius", radius, Dimension::length, "2 mm");
}

void set_units(ReadingOptions& reading, const std::string& text) {
    if (!unit_system(text))
        throw UserError("--units {}: there are no such units; there are {}", text,
                        fmt::join(unit_names(), ", "));
    reading.units = text;
}

void set_moves_with(ReadingOptions& reading, const std::string& text) {
    if (text != "container" && text != "lab") throw UserError("--moves-with {}: say container or lab", text);
    reading.moves_with_container = text == "container";
}

}  // namespace

void add_reading(CLI::App& verb, ReadingOptions& reading) {
    const std::string group = "Files of other programs";
    const auto add = [&](const char* flag, const char* type, const char* about, auto set) {
        verb.add_option_function<std::string>(
                flag,
                [flag, set, &reading](const std::string& text) {
                    check_typed(flag, text);
                    set(reading, text);
                },
                about)
            ->type_name(type)
            ->group(group);
    };
    add("--columns", "MEANING=COLUMN,...",
        "Which column holds what, as in radius=c_rad,type=mol [known names]", set_columns);
    add("--radius", "LENGTH", "Radius of the grains if the file has none: 2mm, or 1=2mm,2=5mm by type",
        set_radius);
    add("--time-step", "TIME", "Length of a step if the file has no times, as in 1us or 1e-6",
        [](ReadingOptions& to, const std::string& text) {
            to.time_step = positive_quantity("--time-step", text, Dimension::time, "1e-6");
        });
    add("--units", "NAME",
        "Units of the file: si, lj, cgs, mm (with g and s), micro, nano, real, metal [as it says, else si]",
        set_units);
    add("--species", "TYPE=NAME,...", "Names of the types, as in 1=small,2=big",
        [](ReadingOptions& to, const std::string& text) {
            for (const auto& [type, name] : pairs_of("--species", text, "1=small,2=big"))
                to.species[type] = name;
        });
    add("--density", "DENSITY", "Density of the grains if the file has none [2500 kg/m3]",
        [](ReadingOptions& to, const std::string& text) {
            to.density = positive_quantity("--density", text, Dimension::density, "2500 kg/m3");
        });
    add("--contacts", "FILE", "Contacts of the same run: a file or a quoted pattern; may be repeated",
        [](ReadingOptions& to, const std::string& text) { to.contacts.push_back(text); });
    add("--walls", "FILE", "Walls: STL, OBJ, PLY, VTK, one or a series (quoted pattern); may be repeated",
        [](ReadingOptions& to, const std::string& text) { to.walls.push_back(text); });
    add("--walls-scale", "NUMBER", "Length of one unit of the walls' files in m, as in 0.001",
        [](ReadingOptions& to, const std::string& text) {
            to.walls_scale = positive_quantity("--walls-scale", text, Dimension::length, "0.001");
        });
    add("--container", "SCENE", "Scene that gives the container, walls and drive around the grains",
        [](ReadingOptions& to, const std::string& text) { to.container = text; });
    add("--moves-with", "WHOM", "What the positions in the file are relative to: lab or container [lab]",
        set_moves_with);
    verb.add_flag("--one", reading.one, "Read this file alone, although it is part of a numbered series")
        ->group(group);
}

std::string given_reading(const ReadingOptions& r) {
    if (!r.columns.empty()) return "--columns";
    if (r.radius || !r.radius_of_type.empty()) return "--radius";
    if (r.time_step) return "--time-step";
    if (!r.units.empty()) return "--units";
    if (!r.species.empty()) return "--species";
    if (r.density) return "--density";
    if (!r.contacts.empty()) return "--contacts";
    if (!r.walls.empty()) return "--walls";
    if (r.walls_scale) return "--walls-scale";
    if (!r.container.empty()) return "--container";
    if (r.moves_with_container) return "--moves-with";
    return r.one ? "--one" : "";
}

}  // namespace grainreel
