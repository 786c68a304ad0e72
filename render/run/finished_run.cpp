#include "render/run/finished_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/period_multiple.hpp"
#include "engine/output/measures_csv.hpp"
#include "engine/scene/film/purposes.hpp"
#include "engine/scene/text/reader.hpp"
#include "render/run/moments/earlier_positions.hpp"
#include "render/run/moments/known_reach.hpp"

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
void check_sets(const Assignments& sets) {
    for (const Assignment& set : sets) {
        const std::string key = set.key();
        const bool of_species = key.rfind("species", 0) == 0 && (ends_with(key, ".colour"));
        if (key.rfind("film.", 0) == 0 || of_species || key == "run.threads") continue;
        if (key == "title") throw UserError("--set title: a film drawn again has its title in film.title");
        throw UserError(
            fmt::format("{}: the run is over; only keys of [film] and the colours of species "
                        "can be changed, or run the scene again with `movie`",
                        set.place()));
    }
}

// The scene of a run names all its values, so that defaults of a purpose would change nothing: they are set.
Assignments with_purpose(const Assignments& sets) {
    Assignments all;
    for (const Assignment& set : sets) {
        const Purpose* purpose = set.key() == "film.for" ? find_purpose(set.value()) : nullptr;
        if (purpose == nullptr) continue;
        all.clear();
        for (std::string& text : assignments_of(*purpose)) all.push_back({std::move(text), set.place()});
    }
    all.insert(all.end(), sets.begin(), sets.end());
    return all;
}

Scene scene_of(const fs::path& folder, const Assignments& sets) {
    check_sets(sets);
    Scene scene =
        read_scene(file_in(folder, "scene.toml", "give the folder of a run of `movie`"), with_purpose(sets));
    scene.name = folder.filename().string();
    return scene;
}

constexpr const char* without_trajectory =
    "the run kept none: it was told so (output.trajectory = false), or it ended before its first frame";

}  // namespace

FinishedRun::FinishedRun(const fs::path& folder, const Assignments& sets)
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
    read_moments();
    check_grains();
    tell_what_is_left_out();
    if (scene_.film.look.rotation && !trajectory_.info().orientation)
        throw UserError(
            fmt::format("{}: has no orientations, and the film shows rotation; run it with "
                        "output.orientation = true, or let film.rotation be false",
                        name));
    frame_what_is_reached();
    if (needs_touches(scene_.film.shows)) read_contacts();
    if (needs_measures(scene_.film.shows)) read_measures_of_run();
    find_periods();
    if (needs_displacement(scene_.film.shows)) look_for_earlier_frames();
}

void FinishedRun::read_moments() {
    const std::string name = (folder_ / "trajectory.nc").string();
    if (!trajectory_.info().checksums)
        warnings_.push_back(
            fmt::format("{}: has no checksums, for an earlier version wrote it; damage that leaves possible "
                        "numbers would not show",
                        name));
    if (trajectory_.uncounted() > 0)
        warnings_.push_back(
            fmt::format("{}: counts {} frames and holds {} more; they are left out. The run goes on, or the "
                        "file's header "
                        "is damaged",
                        name, trajectory_.frames(), trajectory_.uncounted()));
    places_.resize(trajectory_.frames());
    std::iota(places_.begin(), places_.end(), std::size_t{0});
    keep_those([&](std::size_t place) {
        moments_.push_back(trajectory_.read_moment(place));
        add_planes(scene_.walls, moments_.back().time, moments_.back().bodies);
    });
}

void FinishedRun::leave_out_damaged() {
    std::vector<Frame> all = std::move(moments_);
    std::size_t next = 0;
    moments_.clear();
    keep_those([&](std::size_t place) {
        Frame& moment = all[next++];
        trajectory_.read(place);
        if (contacts_) contacts_->touches(place);
        moments_.push_back(std::move(moment));
    });
}

void FinishedRun::keep_those(const std::function<void(std::size_t)>& read) {
    std::vector<std::size_t> kept, damaged;
    std::string first;
    for (const std::size_t place : places_) {
        try {
            read(place);
            kept.push_back(place);
        } catch (const DamagedFrame& error) {
            if (damaged.empty()) first = error.what();
            damaged.push_back(place);
        }
    }
    if (kept.empty()) throw UserError(fmt::format("{} (and no other frame is whole)", first));
    places_ = std::move(kept);
    if (damaged.empty()) return;
    constexpr std::size_t named = 5;
    std::string others;
    for (std::size_t i = 1; i < std::min(damaged.size(), named); ++i)
        others += fmt::format(", {}", damaged[i]);
    warnings_.push_back(fmt::format(
        "{}; {} left out{}", first,
        damaged.size() == 1 ? "it is" : fmt::format("{} frames are", damaged.size()),
        damaged.size() == 1
            ? ""
            : fmt::format(": {}{}{}", damaged.front(), others, damaged.size() > named ? " ..." : "")));
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
    const Frame frame = first_whole();
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

Frame FinishedRun::first_whole() const {
    for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
        try {
            return trajectory_.read(places_[i]);
        } catch (const DamagedFrame&) {
            continue;  // whoever draws it says so
        }
    }
    return trajectory_.read(places_.back());
}

// The camera of a run that is over need not estimate how high the grains get.
void FinishedRun::frame_what_is_reached() {
    Camera& camera = scene_.film.camera;
    if (camera.frame == CameraFrame::reach && !camera.reach && !camera.position)
        camera.reach = known_reach(trajectory_);
}

// The trajectory holds single moments alone, and of those its own.
void FinishedRun::tell_what_is_left_out() {
    const std::vector<FilmSegment>& segments = scene_.film.segments;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].average == 0 && segments[i].exposure == 0) continue;
        const char* const what = segments[i].average > 0 ? "average" : "exposure";
        warnings_.push_back(
            fmt::format("{}: '{}' is left out: frames of a finished run are single moments; run the scene "
                        "again with `movie`",
                        scene_.where(fmt::format("film.segment[{}].{}", i, what)), what));
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
    if (contacts_->uncounted() > 0)
        warnings_.push_back(fmt::format(
            "{}: holds more rows than it counts; the last frames may lack contacts. The run goes on, or the "
            "file's header is damaged",
            file.string()));
    if (!contacts_->has_checksums() && trajectory_.info().checksums)
        warnings_.push_back(fmt::format(
            "{}: has no checksums; damage that leaves possible numbers would not show", file.string()));
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

Frame FinishedRun::grains(std::size_t index) const {
    Frame frame = trajectory_.read(places_.at(index));
    add_planes(scene_.walls, frame.time, frame.bodies);
    return frame;
}

std::optional<std::size_t> FinishedRun::before_these_periods(std::size_t index) const {
    const double period = 1 / scene_.drive.frequency, wanted = moments_[index].time - periods_ * period;
    const std::size_t before = nearest(wanted);
    if (std::abs(moments_[before].time - wanted) > 1e-3 * period) return std::nullopt;
    return before;
}

void FinishedRun::look_for_earlier_frames() {
    const double first = moments_.front().time + (periods_ - 1e-3) / scene_.drive.frequency;
    std::size_t lack = 0;
    for (std::size_t i = 0; i < moments_.size(); ++i)
        lack += moments_[i].time >= first && !before_these_periods(i);
    if (lack > 0)
        warnings_.push_back(fmt::format(
            "{}: {} of its {} frames have none a period before them, and are drawn without displacements; "
            "run the scene with an output.trajectory_interval that divides the period",
            (folder_ / "trajectory.nc").string(), lack, moments_.size()));
}

void FinishedRun::find_periods() {
    if (scene_.film.periods > 0) {
        periods_ = scene_.film.periods;
        return;
    }
    const auto table = measures_ ? measures_ : read_measures(measures());
    if (!table || table->rows() == 0) return;
    const std::vector<std::string>& columns = table->columns();
    const auto column = std::find(columns.begin(), columns.end(), "bed_periods");
    if (column == columns.end()) return;  // of a run before there was one
    const std::size_t last = table->rows() - 1;
    const double found =
        table->values(static_cast<std::size_t>(column - columns.begin()), last, last + 1).front();
    if (found >= 1 && found <= PeriodMultiple::kMost) periods_ = static_cast<int>(found);
}

Frame FinishedRun::frame(std::size_t index) const {
    Frame frame = grains(index);
    if (measures_) {
        const double end = frame.time * (1 + 1e-9) + 1e-12;
        frame.measures = measures_;
        frame.measure_rows = static_cast<std::size_t>(
            std::upper_bound(measured_.begin(), measured_.end(), end) - measured_.begin());
    }
    if (contacts_) frame.touches = contacts_->touches(places_.at(index));
    if (!needs_displacement(scene_.film.shows)) return frame;
    const std::optional<std::size_t> before = before_these_periods(index);
    if (!before) return frame;
    const bool periodic = scene_.container.periodic_depth;
    set_displacement(frame, grains(*before).position, periods_, periodic ? scene_.container.depth : 0);
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
