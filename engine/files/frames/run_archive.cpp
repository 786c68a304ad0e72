#include "engine/files/frames/run_archive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/measure/bed/bed_formulas.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr const char* without_trajectory =
    "the run kept none: it was told so (output.trajectory = false), or it ended before its first frame";

}  // namespace

RunArchive::RunArchive(const fs::path& folder, const Scene& scene, bool for_questions)
    : for_questions_(for_questions),
      folder_(folder),
      scene_(scene),
      trajectory_(file_of_run(folder_, "trajectory.nc", without_trajectory)) {
    const std::string name = name_of("trajectory.nc");
    if (trajectory_.frames() == 0)
        throw UserError(fmt::format("{}: holds no frame yet; the run was stopped before its first", name));
    make_world();
    check_species(scene_, world_, name);
    check_meshes(scene_, world_of(trajectory_.info()), name);
    read_moments();
    clock_ = clock_of(scene_, moments_);
    if (clock_.step == 0 && scene_.run.step) clock_.step = *scene_.run.step;  // for a single moment at step 0
    MeasuresFile measures = read_measures_file(name_of("measures.csv"));
    measures_ = measures.table;
    if (!measures.fault.empty())
        news_.push_back(fmt::format("{}; the rows from there on are left out", measures.fault));
    check_same_run();
    if (for_questions_) look_at_measures();
    find_periods();
}

// What the trajectory says about its world has precedence, because the scene beside it may be of another run.
void RunArchive::make_world() {
    world_ = world_of(scene_);
    const World said = world_of(trajectory_.info());
    if (said.species.size() != world_.species.size()) world_.species = said.species;
    world_.program_version = said.program_version;
    world_.most_grains = said.most_grains;
    world_.traffic = said.traffic;
}

FrameSupply RunArchive::supply() const {
    FrameSupply supply;
    supply.orientations = trajectory_.info().orientation;
    supply.contact_numbers = trajectory_.info().contact_numbers;
    supply.contacts = has_contacts();
    supply.measures = measures_ != nullptr;
    return supply;
}

void RunArchive::read_moments() {
    const std::string name = name_of("trajectory.nc");
    if (!trajectory_.info().checksums)
        news_.push_back(
            fmt::format("{}: has no checksums, for an earlier version wrote it; damage that leaves possible "
                        "numbers would not show",
                        name));
    faults_ = faults_of(trajectory_, name);
    places_.resize(trajectory_.frames());
    std::iota(places_.begin(), places_.end(), std::size_t{0});
    keep_those([&](std::size_t place) {
        moments_.push_back(trajectory_.read_moment(place));
        add_planes(scene_.walls, moments_.back().time, moments_.back().bodies);
    });
}

void RunArchive::leave_out_damaged(bool brought_back) {
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

void RunArchive::keep_those(const std::function<void(std::size_t)>& read, bool brought_back) {
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

void RunArchive::check_same_run() const {
    const std::string trajectory = name_of("trajectory.nc");
    check_grains(scene_, world_, first_whole(), trajectory);
    for (std::size_t i = 0; i < moments_.size(); ++i)
        check_drive(scene_, clock_, moments_[i], fmt::format("{}: frame {}", trajectory, places_[i]));
    if (measures_) check_measures(scene_, clock_, *measures_, *this, name_of("measures.csv"));
}

void RunArchive::read_contacts(bool alone) {
    if (!for_questions_) return use_contacts(alone);
    const std::size_t before = faults_.size();
    try {
        use_contacts(true);
    } catch (const UserError& fault) {
        contacts_.reset();
        faults_.resize(before);
        faults_.emplace_back(fault.what());
    }
}

void RunArchive::use_contacts(bool alone) {
    std::error_code ignored;
    if (!alone && !fs::exists(folder_ / "contacts.nc", ignored)) return;
    if (fs::exists(folder_ / kImportNews, ignored) && !fs::exists(folder_ / "contacts.nc", ignored))
        throw UserError(
            fmt::format("{}: its files say no contacts; name files that do by --contacts, or let "
                        "film.colour.by be something else and film.force_chains false",
                        folder_.filename().string()));
    const char* const why = is_of_another_engine(folder_)
                                ? "another engine computed the run, and its dumps have no contacts; let "
                                  "film.colour.by be something else and film.force_chains false"
                                : "the run was not told to keep contacts (output.contacts = true); let "
                                  "film.colour.by be something else and film.force_chains false";
    const fs::path file = file_of_run(folder_, "contacts.nc", why);
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

// In a file that was cut off some contacts are missing, and those in a damaged row are not known.
bool RunArchive::has_contacts_of(std::size_t index) const {
    if (!contacts_ || !contacts_->has_all(places_.at(index))) return false;
    try {
        contacts_->touches(places_.at(index));
        return true;
    } catch (const UserError&) {
        return false;
    }
}

std::optional<std::vector<Touch>> RunArchive::touches(std::size_t index) const {
    if (!contacts_ || (for_questions_ && !has_contacts_of(index))) return std::nullopt;
    return contacts_->touches(places_.at(index));
}

std::optional<std::vector<SavedContact>> RunArchive::contacts(std::size_t index) const {
    if (!has_contacts_of(index)) return std::nullopt;
    return contacts_->contacts(places_.at(index));
}

std::shared_ptr<const FieldsReader> RunArchive::fields() const {
    std::error_code ignored;
    if (!fs::exists(folder_ / "fields.nc", ignored)) return nullptr;
    return std::make_shared<const FieldsReader>(folder_ / "fields.nc");
}

// A run that is still going on writes the contacts of a frame after the frame, so the last ones may be
// missing.
void RunArchive::leave_out_unfinished_contacts() {
    if (moments_.size() < 2 || !FolderLock::holder(folder_)) return;
    if (!contacts_->touches(places_.back()).empty()) return;
    places_.pop_back();
    moments_.pop_back();
    news_.push_back(
        fmt::format("{}: the run goes on, and the last frame's contacts may not be written yet; it is "
                    "left out",
                    name_of("contacts.nc")));
}

void RunArchive::check_contacts_of_run() const {
    std::vector<Touch> touches;
    Frame frame;
    for (std::size_t i = moments_.size(); i-- > 0 && touches.empty();) {
        try {
            frame = grains(i);
            touches = contacts_->touches(places_[i]);
        } catch (const UserError&) {
            continue;  // the frame is damaged, which is reported when it is drawn
        }
    }
    check_contacts(scene_, touches, frame, name_of("contacts.nc"));
}

// Questions get the nearest row, however far it is, so gaps in the measures are among the faults.
void RunArchive::look_at_measures() {
    const std::string name = name_of("measures.csv");
    const std::vector<double> times = measures_ ? measures_->all("time_s") : std::vector<double>();
    std::error_code ignored;
    if (times.empty()) {
        faults_.push_back(fmt::format("{}: {}, so that what was measured is left out", name,
                                      fs::exists(name, ignored) ? "holds no rows" : "is missing"));
        return;
    }
    const std::size_t rows = times.size();
    const double interval = rows > 1 ? times[rows - 1] - times[rows - 2] : 0, end = moments_.back().time;
    if (times.back() < end - 1.5 * interval - 1e-9)
        faults_.push_back(
            fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s; it was cut off, or a row "
                        "is damaged",
                        name, times.back(), end));
}

void RunArchive::find_periods() {
    const std::vector<double> rows = measures_ ? measures_->all("bed_periods") : std::vector<double>();
    if (rows.empty()) return;  // a run of an earlier version has no such column
    const double found = rows.back();
    if (found >= 1 && found <= PeriodMultiple::kMost) periods_ = static_cast<int>(found);
}

std::optional<std::size_t> RunArchive::index_at(double time) const {
    constexpr double periods = 1e-3, steps = 1.01;
    const double period = scene_.drive.present ? 1 / scene_.drive.highest_frequency() : 0;
    const std::size_t index = nearest(time);
    if (std::abs(moments_[index].time - time) > std::max(periods * period, steps * clock_.step))
        return std::nullopt;
    return index;
}

Frame RunArchive::grains(std::size_t index) const {
    Frame frame = trajectory_.read(places_.at(index));
    add_planes(scene_.walls, frame.time, frame.bodies);
    return frame;
}

std::vector<std::string> RunArchive::news() const {
    std::vector<std::string> all = faults_;
    all.insert(all.end(), news_.begin(), news_.end());
    return all;
}

std::optional<MeasuredRow> RunArchive::measured_near(std::size_t index) const {
    const std::vector<double> times = measures_ ? measures_->all("time_s") : std::vector<double>();
    if (times.empty()) return std::nullopt;
    const double time = moments_.at(index).time;
    std::size_t row = 0;
    for (std::size_t k = 1; k < times.size(); ++k)
        if (std::abs(times[k] - time) < std::abs(times[row] - time)) row = k;
    MeasuredRow measured{times[row], measures_->columns(), {}};
    for (std::size_t k = 0; k < measured.columns.size(); ++k)
        measured.values.push_back(measures_->values(k, row, row + 1).front());
    return measured;
}

}  // namespace grainreel
