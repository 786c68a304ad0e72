#include "render/cli/finished_run.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/output/measures_csv.hpp"
#include "engine/scene/purposes.hpp"
#include "engine/scene/reader.hpp"
#include "render/cli/earlier_positions.hpp"

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

// The scene of a run names all its values, so that defaults of a purpose would change nothing: they are set.
std::vector<std::string> with_purpose(const std::vector<std::string>& sets) {
    const std::string key = "film.for=";
    std::vector<std::string> all;
    for (const std::string& set : sets) {
        const Purpose* purpose = set.rfind(key, 0) == 0 ? find_purpose(set.substr(key.size())) : nullptr;
        if (purpose != nullptr) all = assignments_of(*purpose);
    }
    all.insert(all.end(), sets.begin(), sets.end());
    return all;
}

Scene scene_of(const fs::path& folder, const std::vector<std::string>& sets) {
    check_sets(sets);
    Scene scene =
        read_scene(file_in(folder, "scene.toml", "give the folder of a run of `movie`"), with_purpose(sets));
    scene.name = folder.filename().string();
    return scene;
}

constexpr const char* without_trajectory =
    "the run kept none: it was told so (output.trajectory = false), or it ended before its first frame";

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
    check_grains();
    for (std::size_t i = 0; i < trajectory_.frames(); ++i) moments_.push_back(trajectory_.read_moment(i));
    if (scene_.film.look.rotation && !trajectory_.info().orientation)
        throw UserError(
            fmt::format("{}: has no orientations, and the film shows rotation; run it with "
                        "output.orientation = true, or let film.rotation be false",
                        name));
    if (needs_touches(scene_.film.shows)) read_contacts();
    if (needs_measures(scene_.film.shows)) read_measures_of_run();
    if (needs_displacement(scene_.film.shows)) look_for_earlier_frames();
}

// As many as the scene grows, and of its sizes: another run's trajectory may have as many species.
void FinishedRun::check_grains() const {
    if (scene_.start.method != Start::Method::layers) return;
    const std::string name = (folder_ / "trajectory.nc").string();
    const auto grains = static_cast<std::int64_t>(trajectory_.info().capacity);
    if (grains != scene_.grains())
        throw UserError(
            fmt::format("{}: has {} grains, but scene.toml beside it has {}; they are of two runs", name,
                        grains, scene_.grains()));
    constexpr double kRoom = 1e-4;  // of floats
    const Frame frame = trajectory_.read(0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Species& species = scene_.species[static_cast<std::size_t>(frame.species[i])];
        const double diameter = 2 * frame.radius[i];
        if (diameter > species.diameter.smallest * (1 - kRoom) &&
            diameter < species.diameter.largest * (1 + kRoom))
            continue;
        throw UserError(
            fmt::format("{}: grain {} of '{}' is {:.4g} m wide, but not in scene.toml beside it; they "
                        "are of two runs",
                        name, frame.id[i], species.name, diameter));
    }
}

void FinishedRun::read_contacts() {
    const fs::path file = file_in(folder_, "contacts.nc",
                                  "the run was not told to keep contacts (output.contacts = true); let "
                                  "film.colour.by be something else and film.force_chains false");
    contacts_.emplace(file);
    if (contacts_->cut_off())
        warnings_.push_back(
            fmt::format("{}: was cut off; the last frames are drawn without contacts", file.string()));
}

void FinishedRun::read_measures_of_run() {
    measures_ = read_measures(measures());
    if (!measures_) return;
    const std::vector<std::string>& columns = measures_->columns();
    const auto column = [&](const std::string& name) {
        return std::find(columns.begin(), columns.end(), name) - columns.begin();
    };
    const auto known = [&](const std::string& name) {
        return column(name) < static_cast<std::ptrdiff_t>(columns.size());
    };
    bool all = known("time_s");
    for (const FilmPlot& plot : scene_.film.shows.plots) all = all && known(plot.column);
    for (const LiveWords& part : scene_.film.shows.live_words)
        all = all && (part.column.empty() || known(part.column));
    if (!all) throw UserError(fmt::format("{}: lacks a column that the film shows", measures().string()));
    measured_ = measures_->values(static_cast<std::size_t>(column("time_s")), 0, measures_->rows());
    const std::size_t rows = measured_.size();
    const double last = rows > 0 ? measured_.back() : 0, interval = rows > 1 ? last - measured_[rows - 2] : 0;
    const double end = moments_.back().time;
    if (last < end - 1.5 * interval - 1e-9)
        warnings_.push_back(
            fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s; plots and live words "
                        "stand still from there on",
                        measures().string(), last, end));
}

std::optional<std::size_t> FinishedRun::a_period_before(std::size_t index) const {
    const double period = 1 / scene_.drive.frequency, wanted = moments_[index].time - period;
    const std::size_t before = nearest(wanted);
    if (std::abs(moments_[before].time - wanted) > 1e-3 * period) return std::nullopt;
    return before;
}

void FinishedRun::look_for_earlier_frames() {
    const double first = moments_.front().time + (1 - 1e-3) / scene_.drive.frequency;
    std::size_t lack = 0;
    for (std::size_t i = 0; i < moments_.size(); ++i)
        lack += moments_[i].time >= first && !a_period_before(i);
    if (lack > 0)
        warnings_.push_back(fmt::format(
            "{}: {} of its {} frames have none a period before them, and are drawn without displacements; "
            "run the scene with an output.trajectory_interval that divides the period",
            (folder_ / "trajectory.nc").string(), lack, moments_.size()));
}

Frame FinishedRun::frame(std::size_t index) const {
    Frame frame = trajectory_.read(index);
    if (measures_) {
        const double end = frame.time * (1 + 1e-9) + 1e-12;
        frame.measures = measures_;
        frame.measure_rows = static_cast<std::size_t>(
            std::upper_bound(measured_.begin(), measured_.end(), end) - measured_.begin());
    }
    if (contacts_) frame.touches = contacts_->touches(index);
    if (!needs_displacement(scene_.film.shows)) return frame;
    const std::optional<std::size_t> before = a_period_before(index);
    if (!before) return frame;
    const bool periodic = scene_.container.periodic_depth;
    set_displacement(frame, trajectory_.read(*before).position, periodic ? scene_.container.depth : 0);
    return frame;
}

std::size_t FinishedRun::nearest(double time) const {
    const auto after =
        std::lower_bound(moments_.begin(), moments_.end(), time,
                         [](const Frame& moment, double wanted) { return moment.time < wanted; });
    const auto index = static_cast<std::size_t>(after - moments_.begin());
    if (index == 0) return 0;
    if (index == moments_.size()) return index - 1;
    return time - moments_[index - 1].time <= moments_[index].time - time ? index - 1 : index;
}

}  // namespace grainreel
