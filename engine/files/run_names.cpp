#include "engine/files/run_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Names with .part belong to files that were not finished.
constexpr std::array<std::string_view, 35> files_of_runs{".lock",
                                                         "run.json",
                                                         ".run.json.part",
                                                         "scene.toml",
                                                         ".scene.toml.part",
                                                         "final.csv",
                                                         ".final.csv.part",
                                                         "checkpoint.grs",
                                                         "checkpoint.grs.part",
                                                         "movie.mp4",
                                                         "movie.mp4.part",
                                                         "movie_720.mp4",
                                                         "movie_720.mp4.part",
                                                         "movie.webm",
                                                         "movie.webm.part",
                                                         "movie.gif",
                                                         "movie.mkv",
                                                         "movie.y4m",
                                                         "poster.png",
                                                         "poster.png.part",
                                                         "sheet.png",
                                                         "sheet.png.part",
                                                         "trajectory.nc",
                                                         "contacts.nc",
                                                         "measures.csv",
                                                         "outflow.csv",
                                                         "log.txt",
                                                         "fields.nc",
                                                         "film_moments.nc",
                                                         "key_moments.nc",
                                                         "key_contacts.nc",
                                                         "film_times.csv",
                                                         ".film_times.csv.part",
                                                         kPageName,
                                                         ".report.html.part"};

// movie.work holds what a film needs while it is made.
// handover holds the deck (input script) for another engine, and the files that this engine wrote.
constexpr std::array<std::string_view, 8> folders_of_runs{
    "frames", "movie.work", "checkpoints", "handover", kMeshFolder, kFormerRun, kFormerRunPart, kAlsoFolder};

constexpr std::array<std::string_view, 9> growing_files{
    "trajectory.nc",   "contacts.nc",    "measures.csv",    "outflow.csv", "fields.nc",
    "film_moments.nc", "key_moments.nc", "key_contacts.nc", "log.txt"};

template <std::size_t Count>
bool has(const std::array<std::string_view, Count>& names, const fs::path& name) {
    return contains(names, name.string());
}

// "still-0.500s.png", which `compare --at` writes.
bool is_still(const fs::path& name) {
    constexpr std::string_view begin = "still-", end = "s.png";
    const std::string text = name.string();
    if (!text.starts_with(begin) || !text.ends_with(end) || text.size() <= begin.size() + end.size())
        return false;
    const std::string time = text.substr(begin.size(), text.size() - begin.size() - end.size());
    return time.find_first_not_of("0123456789.-") == std::string::npos;
}

void check_plain(const fs::path& path, bool folder) {
    const std::string other = other_than_file(path, false);
    if (other == (folder ? "a folder" : "")) return;
    if (folder && other.empty() && !fs::exists(path)) return;
    throw UserError("{}: is {}, where a run has {} of its own; remove it", path.string(),
                    other.empty() ? "a file" : other, folder ? "a folder" : "a file");
}

void check_all_inside(const fs::path& folder) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const bool deeper = entry.symlink_status(error).type() == fs::file_type::directory;
        check_plain(entry.path(), deeper);
        if (deeper) check_all_inside(entry.path());
    }
}

}  // namespace

bool is_of_another_engine(const fs::path& run) {
    const fs::path folder = is_folder(run) ? run : run.parent_path();
    const auto has_facts = [&](const fs::path& place) { return is_plain(place / kHandoverFacts); };
    if (has_facts(folder) || has_facts(folder / kHandoverFolder)) return true;
    // While a dump is followed, its moments lie in a hidden folder of the hand-over.
    return folder.filename().string().starts_with('.') && folder.has_parent_path() &&
           folder.filename() != "." && folder.filename() != ".." && has_facts(folder.parent_path());
}

bool is_file_of_runs(const fs::path& name) {
    return has(files_of_runs, name) || is_still(name);
}

bool is_folder_of_runs(const fs::path& name) {
    return has(folders_of_runs, name);
}

bool is_frame(const fs::path& name) {
    const std::string stem = name.stem().string();
    return name.extension() == ".png" && stem.size() >= 6 &&
           stem.find_first_not_of("0123456789") == std::string::npos;
}

bool is_checkpoint_of_ring(const fs::path& name) {
    const std::string text = name.string(), digits = text.substr(0, text.find('.'));
    const std::string end = text.substr(digits.size());
    return !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos &&
           (end == ".grs" || end == ".grs.part");
}

bool is_in_also(const fs::path& name) {
    constexpr std::array<std::string_view, 8> endings{".vtp", ".vti", ".pvd",  ".nc",
                                                      ".xyz", ".csv", ".dump", ".data"};
    constexpr std::array<std::string_view, 7> more{".vtkhdf", ".stl", ".gsd", ".glb", ".json", ".bin", ".py"};
    const auto known = [&](const auto& list) {
        return std::any_of(list.begin(), list.end(),
                           [&](std::string_view ending) { return name.extension() == ending; });
    };
    const bool unfinished =
        name.string().starts_with('.') && name.string().find(".part") != std::string::npos;
    return unfinished || known(endings) || known(more);
}

bool grows(const fs::path& name) {
    return has(growing_files, name);
}

void check_all_plain(const fs::path& run) {
    for (const std::string_view name : files_of_runs) check_plain(run / name, false);
    for (const std::string_view name : folders_of_runs) {
        check_plain(run / name, true);
        check_all_inside(run / name);
    }
}

}  // namespace grainreel
