#include "render/run/frames/recorded_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/measure/bed/period_multiple.hpp"
#include "engine/state/face_names.hpp"
#include "render/run/frames/choice.hpp"
#include "render/run/frames/recorded_scene.hpp"
#include "render/run/frames/same_run.hpp"
#include "render/run/moments/known_reach.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr const char* without_trajectory =
    "the run kept none: it was told so (output.trajectory = false), or it ended before its first frame";

}  // namespace

RecordedRun::RecordedRun(const fs::path& folder, const Assignments& sets, Use use)
    : for_questions_(use.for_questions),
      folder_(folder_of_run(folder)),
      scene_(scene_of_run(folder_, sets)),
      trajectory_(file_of_run(folder_, "trajectory.nc", without_trajectory)) {
    const std::string name = name_of("trajectory.nc");
    if (trajectory_.frames() == 0)
        throw UserError(fmt::format("{}: holds no frame yet; the run was stopped before its first", name));
    check_species(scene_, trajectory_.info(), name);
    read_moments();
    clock_ = clock_of(scene_, moments_);
    if (clock_.step == 0 && scene_.run.step) clock_.step = *scene_.run.step;  // with one moment at step 0
    MeasuresFile measures = read_measures_file(name_of("measures.csv"));
    measures_ = measures.table;
    if (!measures.fault.empty())
        news_.push_back(fmt::format("{}; the rows from there on are left out", measures.fault));
    check_same_run();
    if (use.for_questions) look_at_measures();
    if (scene_.film.look.rotation && !trajectory_.info().orientation)
        throw UserError(
            fmt::format("{}: has no orientations, and the film shows rotation; run it with "
                        "output.orientation = true, or let film.rotation be false",
                        name));
    if (!use.for_questions) frame_what_is_reached();
    if (needs_touches(scene_.film.shows))
        use.for_questions ? read_contacts_for_questions() : read_contacts(use.alone);
    if (needs_measures(scene_.film.shows)) read_measures_of_run();
    if (scene_.film.shows.outflow) read_outflow_of_run();
    find_periods();
    parts_.emplace(scene_, clock_, moments_.front().step);
    if (use.alone) do_without_others();
}

// The trajectory holds single moments, and of those its own.
void RecordedRun::do_without_others() {
    if (needs_touches(scene_.film.shows) && !contacts_ && !for_questions_) read_contacts(true);
    for (std::string& line :
         single_moment_warnings(scene_,
                                "frames that a run kept are single moments; let them be brought back, "
                                "or run the scene again with `movie`"))
        news_.push_back(std::move(line));
    if (needs_displacement(scene_.film.shows)) look_for_earlier_frames();
}

Supply RecordedRun::supply() const {
    return {false, contacts_.has_value(), measures_ != nullptr, trajectory_.info().orientation};
}

void RecordedRun::read_moments() {
    const std::string name = name_of("trajectory.nc");
    if (!trajectory_.info().checksums)
        news_.push_back(
            fmt::format("{}: has no checksums, for an earlier version wrote it; damage that leaves possible "
                        "numbers would not show",
                        name));
    if (trajectory_.cut_off())
        faults_.push_back(fmt::format(
            "{}: frame {} (the first is 0) is not whole, and is left out; the run was killed while "
            "it wrote that frame, or the copy of the file was cut off",
            name, trajectory_.frames()));
    if (trajectory_.uncounted() > 0)
        faults_.push_back(
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

void RecordedRun::leave_out_damaged(bool brought_back) {
    std::vector<Frame> all = std::move(moments_);
    std::size_t next = 0;
    moments_.clear();
    keep_those(
        [&](std::size_t place) {
            Frame& moment = all[next++];
            const Frame grains = trajectory_.read(place);
            if (measures_) check_measured(scene_, *measures_, grains, name_of("measures.csv"));
            if (contacts_) contacts_->touches(place);
            moments_.push_back(std::move(moment));
        },
        brought_back);
}

void RecordedRun::keep_those(const std::function<void(std::size_t)>& read, bool brought_back) {
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
    faults_.push_back(fmt::format(
        "{}; {} {}{}", first, damaged.size() == 1 ? "it is" : fmt::format("{} frames are", damaged.size()),
        brought_back ? "brought back" : "left out",
        damaged.size() == 1
            ? ""
            : fmt::format(": {}{}{}", damaged.front(), others, damaged.size() > named ? " ..." : "")));
}

void RecordedRun::check_same_run() const {
    const std::string trajectory = name_of("trajectory.nc");
    check_grains(scene_, trajectory_.info(), first_whole(), trajectory);
    for (std::size_t i = 0; i < moments_.size(); ++i)
        check_drive(scene_, clock_, moments_[i], fmt::format("{}: frame {}", trajectory, places_[i]));
    if (measures_) check_measures(scene_, clock_, *measures_, *this, name_of("measures.csv"));
}

// The camera of a run that is over need not estimate how high the grains get.
void RecordedRun::frame_what_is_reached() {
    Camera& camera = scene_.film.camera;
    if (camera.frame == CameraFrame::reach && !camera.reach && !camera.position)
        camera.reach = known_reach(trajectory_);
}

void RecordedRun::read_contacts(bool alone) {
    std::error_code ignored;
    if (!alone && !fs::exists(folder_ / "contacts.nc", ignored)) return;
    const fs::path file = file_of_run(folder_, "contacts.nc",
                                      "the run was not told to keep contacts (output.contacts = true); let "
                                      "film.colour.by be something else and film.force_chains false");
    contacts_.emplace(file);
    if (!alone && contacts_->cut_off()) {
        contacts_.reset();
        news_.push_back(fmt::format("{}: was cut off; contacts are brought back", file.string()));
        return;
    }
    if (contacts_->cut_off())
        faults_.push_back(
            fmt::format("{}: was cut off; the last frames are drawn without contacts", file.string()));
    if (contacts_->uncounted() > 0)
        faults_.push_back(fmt::format(
            "{}: holds more rows than it counts; the last frames may lack contacts. The run goes on, or the "
            "file's header is damaged",
            file.string()));
    if (!contacts_->has_checksums() && trajectory_.info().checksums)
        news_.push_back(fmt::format(
            "{}: has no checksums; damage that leaves possible numbers would not show", file.string()));
    leave_out_unfinished_contacts();
    check_contacts_of_run();
}

void RecordedRun::read_contacts_for_questions() {
    const std::size_t before = faults_.size();
    try {
        read_contacts(true);
    } catch (const UserError& fault) {
        contacts_.reset();
        faults_.resize(before);
        faults_.emplace_back(fault.what());
    }
}

// Those of a file that was cut off are not all there, and those of a damaged row are not known.
bool RecordedRun::has_contacts_of(std::size_t index) const {
    if (!contacts_ || !contacts_->has_all(places_.at(index))) return false;
    try {
        contacts_->touches(places_.at(index));
        return true;
    } catch (const UserError&) {
        return false;
    }
}

const OwnCheckpoints& RecordedRun::own() const {
    if (!own_) own_ = own_checkpoints(folder_, scene_);
    return *own_;
}

std::vector<std::string> RecordedRun::news() const {
    std::vector<std::string> all = faults_;
    all.insert(all.end(), news_.begin(), news_.end());
    return all;
}

// A run that goes on writes a frame's contacts after the frame.
void RecordedRun::leave_out_unfinished_contacts() {
    if (moments_.size() < 2 || !FolderLock::holder(folder_)) return;
    if (!contacts_->touches(places_.back()).empty()) return;
    places_.pop_back();
    moments_.pop_back();
    news_.push_back(
        fmt::format("{}: the run goes on, and the last frame's contacts may not be written yet; it is "
                    "left out",
                    name_of("contacts.nc")));
}

void RecordedRun::check_contacts_of_run() const {
    std::vector<Touch> touches;
    Frame frame;
    for (std::size_t i = moments_.size(); i-- > 0 && touches.empty();) {
        try {
            frame = grains(i);
            touches = contacts_->touches(places_[i]);
        } catch (const UserError&) {
            continue;  // damage; whoever draws it says so
        }
    }
    check_contacts(scene_, touches, frame, name_of("contacts.nc"));
}

void RecordedRun::read_measures_of_run() {
    const std::string name = name_of("measures.csv");
    std::error_code error;
    if (!fs::exists(name, error)) return leave_out_measures("is missing");
    if (!measures_ || measures_->rows() == 0) return leave_out_measures("holds no row");
    check_columns();
    const std::size_t rows = measures_->rows();
    measured_ = measures_->values(*column_of(*measures_, "time_s"), 0, rows);
    const double last = measured_.back(), interval = rows > 1 ? last - measured_[rows - 2] : 0;
    const double end = moments_.back().time;
    if (last < end - 1.5 * interval - 1e-9)
        news_.push_back(
            fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s; plots and live words "
                        "stand still from there on",
                        name, last, end));
}

// A question gets the row that is nearest, however far that is.
void RecordedRun::look_at_measures() {
    const std::string name = name_of("measures.csv");
    const auto time = measures_ ? column_of(*measures_, "time_s") : std::nullopt;
    std::error_code ignored;
    if (!time || measures_->rows() == 0) {
        faults_.push_back(fmt::format("{}: {}, so that what was measured is left out", name,
                                      fs::exists(name, ignored) ? "holds no rows" : "is missing"));
        return;
    }
    const std::size_t rows = measures_->rows();
    const std::vector<double> times = measures_->values(*time, 0, rows);
    const double interval = rows > 1 ? times[rows - 1] - times[rows - 2] : 0, end = moments_.back().time;
    if (times.back() < end - 1.5 * interval - 1e-9)
        faults_.push_back(
            fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s; it was cut off, or a row "
                        "is damaged",
                        name, times.back(), end));
}

// Empty plots, and words without their values, would look as if the run had been so.
void RecordedRun::leave_out_measures(const std::string& why) {
    FilmShows& shows = scene_.film.shows;
    std::vector<std::string> left_out;
    if (std::erase_if(shows.plots, [](const FilmPlot& plot) { return !plot.is_profile(); }) > 0)
        left_out.emplace_back("plots");
    if (std::exchange(shows.wall_forces.wanted, false)) left_out.emplace_back("forces on walls");
    if (needs_measures(shows)) {
        shows.live_words.clear();
        left_out.emplace_back("live words");
    }
    news_.push_back(
        fmt::format("{}: {}; {} are left out", name_of("measures.csv"), why, fmt::join(left_out, " and ")));
}

void RecordedRun::check_columns() const {
    const auto need = [&](const std::string& name, const std::string& what) {
        if (!name.empty() && !column_of(*measures_, name))
            throw UserError(
                fmt::format("{}: lacks the column {}, which {}; take that out of the film, or run "
                            "the scene again with it",
                            name_of("measures.csv"), name, what));
    };
    need("time_s", "every run has");
    for (const FilmPlot& plot : scene_.film.shows.plots) need(plot.column, "film.plot shows");
    for (const LiveWords& part : scene_.film.shows.live_words) need(part.column, "film.text shows");
    if (!scene_.film.shows.wall_forces.wanted) return;
    for (const std::string& face : face_names(scene_)) need(face + "_force_z_N", "film.wall_forces shows");
}

void RecordedRun::read_outflow_of_run() {
    const std::string name = name_of("outflow.csv");
    outflow_ = OutflowRecord::read(name, scene_);
    if (!outflow_) news_.push_back(fmt::format("{}: is missing; how much has flowed out is left out", name));
}

void RecordedRun::find_periods() {
    if (scene_.film.periods > 0) {
        periods_ = scene_.film.periods;
        return;
    }
    if (!measures_ || measures_->rows() == 0) return;
    const std::optional<std::size_t> column = column_of(*measures_, "bed_periods");
    if (!column) return;  // of a run before there was one
    const std::size_t last = measures_->rows() - 1;
    const double found = measures_->values(*column, last, last + 1).front();
    if (found >= 1 && found <= PeriodMultiple::kMost) periods_ = static_cast<int>(found);
}

// The frame of that moment, when there is one: frames lie on steps, and so do the moments that are wanted.
std::optional<std::size_t> RecordedRun::index_at(double time) const {
    constexpr double periods = 1e-3, steps = 1.01;
    const double period = scene_.drive.present ? 1 / scene_.drive.highest_frequency() : 0;
    const std::size_t index = nearest(time);
    if (std::abs(moments_[index].time - time) > std::max(periods * period, steps * clock_.step))
        return std::nullopt;
    return index;
}

void RecordedRun::look_for_earlier_frames() {
    const double first = moments_.front().cycles + periods_ - 1e-3;
    std::size_t lack = 0;
    for (const Frame& moment : moments_)
        lack += moment.cycles >= first && !index_at(clock_.time(clock_.step_at(moment.cycles - periods_)));
    if (lack > 0)
        news_.push_back(fmt::format(
            "{}: {} of its {} frames have none a period before them, and are drawn without displacements; "
            "run the scene with an output.trajectory_interval that divides the period",
            name_of("trajectory.nc"), lack, moments_.size()));
}

FramePtr RecordedRun::at(std::int64_t step) const {
    const std::optional<std::size_t> index = index_at(clock_.time(step));
    return index ? std::make_shared<const Frame>(grains(*index)) : nullptr;
}

std::vector<Touch> RecordedRun::touches(const Frame& frame) const {
    const std::size_t index = nearest(frame.time);
    if (!contacts_ || (for_questions_ && !has_contacts_of(index))) return {};
    return contacts_->touches(places_.at(index));
}

std::optional<FlowedOut> RecordedRun::flowed_out(const Frame& frame) const {
    return outflow_ ? std::optional(outflow_->until(frame.time)) : std::nullopt;
}

PartSupply::Measured RecordedRun::measured(const Frame& frame) const {
    const double end = frame.time * (1 + 1e-9) + 1e-12;
    const auto after = std::upper_bound(measured_.begin(), measured_.end(), end);
    return {measures_, static_cast<std::size_t>(after - measured_.begin())};
}

Frame RecordedRun::grains(std::size_t index) const {
    Frame frame = trajectory_.read(places_.at(index));
    add_planes(scene_.walls, frame.time, frame.bodies);
    return frame;
}

Frame RecordedRun::frame(std::size_t index) const {
    Frame frame = grains(index);
    parts_->add(frame, FilmSegment(), periods_, *this);
    return frame;
}

std::optional<MeasuredRow> RecordedRun::measured_near(std::size_t index) const {
    if (!measures_ || measures_->rows() == 0) return std::nullopt;
    const std::optional<std::size_t> time_column = column_of(*measures_, "time_s");
    if (!time_column) return std::nullopt;
    const std::vector<double> times = measures_->values(*time_column, 0, measures_->rows());
    const double time = moments_.at(index).time;
    std::size_t row = 0;
    for (std::size_t k = 1; k < times.size(); ++k)
        if (std::abs(times[k] - time) < std::abs(times[row] - time)) row = k;
    MeasuredRow measured{times[row], measures_->columns(), {}};
    for (std::size_t k = 0; k < measured.columns.size(); ++k)
        measured.values.push_back(measures_->values(k, row, row + 1).front());
    return measured;
}

std::vector<Frame> RecordedRun::moments(const Pictures& pictures) const {
    std::vector<Frame> moments;
    for (const Instant& instant : pictures.instants) moments.push_back(moments_[nearest(instant.time)]);
    return moments;
}

void RecordedRun::start(const Pictures& pictures) {
    pictures_ = pictures;
}

std::optional<Taken> RecordedRun::next(const GoOn& go_on) {
    if (!go_on() || next_ == pictures_.instants.size()) return std::nullopt;
    const Instant& instant = pictures_.instants[next_++];
    Frame frame = grains(nearest(instant.time));
    parts_->add(frame, pictures_.segments.at(static_cast<std::size_t>(instant.segment)), periods_, *this);
    return Taken{std::make_shared<const Frame>(std::move(frame)), instant.segment, periods_};
}

}  // namespace grainreel
