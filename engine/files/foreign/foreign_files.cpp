// The part of ForeignArchive that chooses the files of a run: those of the grains, and of contacts and walls
// beside them. foreign_reader() is its entry in the list of readers of frames.
#include "engine/files/foreign/foreign_archive.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/file_groups.hpp"
#include "engine/files/run_json.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// What a file holds, judged by its first frame.
enum class Holds { nothing, grains, contacts, walls };

Holds what_holds(const fs::path& file) {
    const RawFormat* format = raw_format_of(file);
    if (format == nullptr) return Holds::nothing;
    try {
        const std::unique_ptr<RawFile> one = format->open(file);
        for (const RawMoment& moment : one->moments()) {
            if (moment.grains > 0) return Holds::grains;
            if (moment.has_walls) return Holds::walls;
            if (moment.has_contacts) return Holds::contacts;
        }
        return one->moments().empty() ? Holds::nothing : Holds::grains;
    } catch (const UserError&) {
        return Holds::nothing;
    }
}

// The names of the group's files. For a list of files (.pvd, .series) these are the files that it names.
std::set<std::string> files_behind(const FileGroup& group) {
    std::set<std::string> names;
    const RawFormat* format = raw_format_of(group.files.front());
    if (format == nullptr || std::string(format->name) != "vtk-collection") {
        for (const fs::path& file : group.files) names.insert(file.filename().string());
        return names;
    }
    std::ifstream in = read_plain(group.files.front());
    std::string text;
    for (bool quoted = false; std::getline(in, text, '"'); quoted = !quoted)
        if (quoted) names.insert(fs::path(text).filename().string());
    return names;
}

// Whether both groups have the same files, or some of them, as a folder of VTK files and the lists of them.
bool share_files(const FileGroup& a, const FileGroup& b) {
    const std::set<std::string> names = files_behind(a), others = files_behind(b);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.find('.') != std::string::npos && others.count(name) > 0;
    });
}

bool is_passed_over(const fs::path& file) {
    return file.filename().string().find("_boundingBox") != std::string::npos;
}

std::vector<fs::path> without_passed_over(std::vector<fs::path> files) {
    std::erase_if(files, is_passed_over);
    return files;
}

// ": out/weak, out/strong", the runs of which the film in this folder was drawn, as its run.json names them.
std::string drawn_in(const fs::path& folder) {
    const RunJson record = read_run_json(folder / "run.json").record;
    std::vector<std::string> runs;
    for (const std::string& panel : record.panels) runs.push_back((folder / panel).string());
    if (runs.empty())
        for (const DrawnFrom& one : record.drawn) runs.push_back(one.folder);
    return runs.empty() ? "" : fmt::format(": {}", fmt::join(runs, ", "));
}

std::vector<fs::path> files_named(const std::string& name) {
    const fs::path path = name;
    if (is_pattern(path)) return without_passed_over(files_of_pattern(path));
    if (!is_folder(path)) return {path};
    if (is_there(path / "film_times.csv") && is_there(path / "run.json"))
        throw UserError(
            "{}: is the folder of a film alone; give the files, or the run, that it was drawn from{}",
            path.string(), drawn_in(path));
    return without_passed_over(files_in(path));
}

}  // namespace

bool is_foreign(const fs::path& path) {
    if (is_pattern(path)) return true;
    if (!is_folder(path)) return is_there(path) && raw_format_of(path) != nullptr;
    if (is_there(path / "scene.toml")) return false;
    for (const fs::path& file : files_in(path))
        if (!is_passed_over(file) && raw_format_of(file) != nullptr) return true;
    return false;
}

void ForeignArchive::choose_files() {
    const bool many = is_pattern(path_) || is_folder(path_);
    if (many) {
        choose_from(files_named(path_.string()));
    } else {
        const FileGroup series = series_of(path_);
        const bool runs = !options_.one && are_different_runs(series);
        alone_ = options_.one || runs;
        if (alone_ || series.files.size() == 1) {
            grains_ = std::make_unique<RawSeries>(std::vector<fs::path>{path_});
            if (runs)
                news_.push_back(
                    fmt::format("{}: is read alone, since the files of '{}' begin with the same "
                                "moment of the same grains, as those of different runs do",
                                path_.string(), series.pattern));
            else if (series.files.size() > 1)
                news_.push_back(fmt::format("{}: is one of {} numbered files; '{}' is all of them",
                                            path_.string(), series.files.size(), series.pattern));
        } else {
            grains_ = std::make_unique<RawSeries>(series.files);
            news_.push_back(
                fmt::format("{}: is one of {} numbered files, and all are read; --one reads it alone",
                            path_.string(), series.files.size()));
        }
        add_companions(path_);
    }
    if (!options_.contacts.empty()) contacts_ = std::make_unique<RawSeries>(contact_files());
    if (!options_.walls.empty()) find_walls();
}

// The files of the contacts that the user names.
std::vector<fs::path> ForeignArchive::contact_files() const {
    std::vector<fs::path> files;
    for (const std::string& name : options_.contacts)
        for (fs::path& file : files_named(name)) files.push_back(std::move(file));
    return grouped(files).size() == 1 ? grouped(files).front().files : files;
}

// Finds the files of the walls that the user names.
void ForeignArchive::find_walls() {
    wall_files_.clear();
    for (const std::string& name : options_.walls)
        for (FileGroup& group : grouped(files_named(name))) wall_files_.push_back(std::move(group.files));
}

// The files that a series has by now: all of its group that lie where the path says.
std::vector<fs::path> ForeignArchive::files_now(const std::vector<fs::path>& known) const {
    if (alone_) return known;
    const bool many = is_pattern(path_) || is_folder(path_);
    for (FileGroup& group : many ? grouped(files_named(path_.string())) : std::vector{series_of(path_)}) {
        if (!contains(group.files, known.front())) continue;
        const bool more = group.files.size() > known.size();
        return more && !is_pattern(path_) && are_different_runs(group) ? known : std::move(group.files);
    }
    return known;
}

namespace {

// The groups of files, with each file by itself where those of a group are of different runs.
std::vector<FileGroup> runs_apart(std::vector<FileGroup> groups) {
    std::vector<FileGroup> apart;
    for (FileGroup& group : groups) {
        if (!are_different_runs(group)) {
            apart.push_back(std::move(group));
            continue;
        }
        for (fs::path& file : group.files) apart.push_back({file.string(), {file}});
    }
    return apart;
}

}  // namespace

// If a folder has several series of grains, the longest is taken, because a run is often written in two
// formats.
void ForeignArchive::choose_from(const std::vector<fs::path>& files) {
    // A pattern says itself which files belong together.
    const std::vector<FileGroup> groups = is_pattern(path_) ? grouped(files) : runs_apart(grouped(files));
    const FileGroup* chosen = nullptr;
    std::vector<const FileGroup*> contacts, walls, others;
    for (const FileGroup& group : groups) {
        // The first frames of a series may be empty, so its middle is asked as well.
        Holds holds = what_holds(group.files.front());
        if (holds != Holds::walls && group.files.size() > 1) {
            const Holds middle = what_holds(group.files[group.files.size() / 2]);
            if (middle != Holds::nothing) holds = middle;
        }
        if (holds == Holds::grains) {
            if (chosen) others.push_back(chosen->files.size() < group.files.size() ? chosen : &group);
            if (!chosen || chosen->files.size() < group.files.size()) chosen = &group;
        }
        if (holds == Holds::contacts) contacts.push_back(&group);
        if (holds == Holds::walls) walls.push_back(&group);
    }
    if (chosen == nullptr)
        throw UserError("{}: no file there holds grains that can be read; {} were looked at", path_.string(),
                        files.size());
    for (const FileGroup& group : grouped(files))
        if (contains(group.files, chosen->files.front())) alone_ = group.files.size() > chosen->files.size();
    grains_ = std::make_unique<RawSeries>(chosen->files);
    for (const FileGroup* other : others)
        if (!share_files(*chosen, *other))
            news_.push_back(fmt::format("{}: holds grains too and is passed over; name it alone to read it",
                                        other->pattern));
    if (options_.contacts.empty() && !contacts.empty())
        contacts_ = std::make_unique<RawSeries>(contacts.front()->files);
    if (!options_.walls.empty()) return;
    // If there are surfaces for each moment, they show the walls where they are then. A single file beside
    // them is the shape that they were made from.
    const bool moving =
        std::any_of(walls.begin(), walls.end(), [](const FileGroup* one) { return one->files.size() > 1; });
    for (const FileGroup* wall : walls) {
        if (moving && wall->files.size() == 1)
            news_.push_back(fmt::format(
                "{}: a single surface beside those of each moment is passed over; --walls takes it",
                wall->pattern));
        else
            wall_files_.push_back(wall->files);
    }
    if (wall_files_.empty()) return;
    std::vector<std::string> names;
    for (const FileGroup* wall : walls)
        if (!moving || wall->files.size() > 1) names.push_back(fs::path(wall->pattern).filename().string());
    news_.push_back(fmt::format("{}: walls are taken from {}; --walls names others", path_.string(),
                                fmt::join(names, ", ")));
}

// Adds contacts and walls of MercuryDPM, which writes NAME.data, NAME.fstat and NAME.restart.
void ForeignArchive::add_companions(const fs::path& file) {
    if (grains_->facts().program.find("Mercury") == std::string::npos &&
        grains_->facts().format.find("Mercury") == std::string::npos)
        return;
    fs::path other = file;
    other.replace_extension(".fstat");
    if (other != file && options_.contacts.empty() && is_plain(other) && raw_format_of(other) != nullptr)
        contacts_ = std::make_unique<RawSeries>(std::vector<fs::path>{other});
    other.replace_extension(".restart");
    if (other != file && options_.walls.empty() && is_plain(other) && what_holds(other) != Holds::nothing)
        wall_files_.push_back({other});
}

namespace {

bool takes(const FileStart& head) {
    return is_foreign(head.path);
}

std::unique_ptr<StateArchive> open(const std::filesystem::path& path, const OpenRequest& request) {
    return std::make_unique<ForeignArchive>(path, request.reading);
}

}  // namespace

ReadFormat foreign_reader() {
    return {
        "foreign",
        "files of other programs: LAMMPS, LIGGGHTS, MercuryDPM, YADE, Lethe, VTK, XYZ, GSD, H5MD, AMBER, CSV",
        takes, open};
}

}  // namespace grainreel
