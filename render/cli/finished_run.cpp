#include "render/cli/finished_run.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/reader.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// "a/b/" and "a/b/." mean "a/b", and "." has a name too.
fs::path plain(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw UserError(fmt::format("{}: no such folder; give the folder of a run", folder.string()));
    const fs::path normal = folder.lexically_normal();
    if (normal.has_filename() && normal.filename() != "." && normal.filename() != "..") return normal;
    return normal.has_filename() || !normal.has_parent_path() ? fs::canonical(folder) : normal.parent_path();
}

fs::path file_in(const fs::path& folder, const char* name, const char* advice) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
    throw UserError(fmt::format("{}: has no {}; {}", folder.string(), name, advice));
}

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The run is over: what would have made it another run must not look as if it had.
void check_sets(const std::vector<std::string>& sets) {
    for (const std::string& set : sets) {
        std::string key = set.substr(0, set.find('='));
        key.erase(std::remove(key.begin(), key.end(), ' '), key.end());
        const bool of_species = key.rfind("species", 0) == 0 && (ends_with(key, ".colour"));
        if (key.rfind("film.", 0) == 0 || of_species || key == "run.threads") continue;
        if (key == "title") throw UserError("--set title: a film drawn again has its title in film.title");
        throw UserError(
            fmt::format("--set {}: the run is over; only keys of [film] and the colours of species "
                        "can be changed, or run the scene again with `movie`",
                        key));
    }
}

Scene scene_of(const fs::path& folder, const std::vector<std::string>& sets) {
    check_sets(sets);
    Scene scene = read_scene(file_in(folder, "scene.toml", "give the folder of a run of `movie`"), sets);
    scene.name = folder.filename().string();
    return scene;
}

constexpr const char* without_trajectory = "the run was told to keep none (output.trajectory)";

}  // namespace

FinishedRun::FinishedRun(const fs::path& folder, const std::vector<std::string>& sets)
    : folder_(plain(folder)),
      scene_(scene_of(folder_, sets)),
      trajectory_(file_in(folder_, "trajectory.nc", without_trajectory)) {
    const std::string name = (folder_ / "trajectory.nc").string();
    if (trajectory_.frames() == 0)
        throw UserError(fmt::format("{}: holds no frame yet; the run was stopped before its first", name));
    const std::vector<std::string>& species = trajectory_.info().species;
    if (species.size() != scene_.species.size())
        throw UserError(
            fmt::format("{}: has {} species, but scene.toml beside it has {}; they are of two runs", name,
                        species.size(), scene_.species.size()));
    for (std::size_t i = 0; i < trajectory_.frames(); ++i) moments_.push_back(trajectory_.read_moment(i));
}

std::size_t FinishedRun::nearest(double time) const {
    const auto nearer = std::min_element(
        moments_.begin(), moments_.end(),
        [&](const Frame& a, const Frame& b) { return std::abs(a.time - time) < std::abs(b.time - time); });
    return static_cast<std::size_t>(nearer - moments_.begin());
}

}  // namespace grainreel
