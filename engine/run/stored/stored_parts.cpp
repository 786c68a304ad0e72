// What lies beside the trajectory in a run's folder, as parts of StoredRun: contacts, measures, wear of
// walls, what has flowed out, fields. What is wrong with a file becomes a Lack.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/measure/bed/bed_formulas.hpp"
#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/run/stored/stored_run.hpp"

namespace grainreel {

namespace fs = std::filesystem;

void StoredRun::read_measures() {
    MeasuresFile file = read_measures_file(name_of("measures.csv"));
    measures_ = std::move(file.table);
    if (!file.fault.empty())
        news_.push_back(fmt::format("{}; the rows from there on are left out", file.fault));
    if (!measures_) return;
    check_measures(scene_, clock_, *measures_, *this, name_of("measures.csv"));
    const std::vector<double> periods = measures_->all("bed_periods");
    if (periods.empty()) return;  // a run of an earlier version has no such column
    if (periods.back() >= 1 && periods.back() <= PeriodMultiple::kMost)
        periods_ = static_cast<int>(periods.back());
}

void StoredRun::use_contacts() {
    if (contacts_ || contacts_lack_) return;
    try {
        open_contacts();
    } catch (const UserError& fault) {
        contacts_.reset();
        contacts_lack_ = Lack{.what = fault.what(), .damaged = true};
    }
}

void StoredRun::open_contacts() {
    const std::string name = name_of("contacts.nc");
    if (!is_there(name)) {
        contacts_lack_ = Lack{.what = name + ": is missing"};
        return;
    }
    contacts_.emplace(name);
    if (contacts_->cut_off()) contacts_lack_ = Lack{.what = name + ": was cut off", .some = true};
    if (contacts_->uncounted() > 0)
        faults_.push_back(fmt::format(
            "{}: holds more rows than it counts; the last frames may lack contacts. The run goes on, or the "
            "file's header is damaged",
            name));
    if (!contacts_->has_checksums())
        news_.push_back(
            fmt::format("{}: has no checksums; damage that leaves possible numbers would not show", name));
    leave_out_unfinished_contacts();
    check_contacts_of_run();
}

// In a file that was cut off some contacts are missing, and those in a damaged row are not known.
bool StoredRun::has_contacts_of(std::size_t index) const {
    if (!contacts_) return frames_->has_contacts_of(number(index));
    const std::size_t frame = place(index);
    if (!contacts_->has_all(frame)) return false;
    const auto known = whole_contacts_.find(frame);
    if (known != whole_contacts_.end()) return known->second;
    try {
        contacts_->touches(frame);
        return whole_contacts_[frame] = true;
    } catch (const UserError&) {
        return whole_contacts_[frame] = false;
    }
}

std::optional<std::vector<Link>> StoredRun::touches(std::size_t index) const {
    if (!contacts_) return frames_->touches(number(index));
    return has_contacts_of(index) ? std::optional(contacts_->touches(place(index))) : std::nullopt;
}

std::optional<std::vector<SavedContact>> StoredRun::contacts(std::size_t index) const {
    if (!contacts_) return frames_->contacts(number(index));
    return has_contacts_of(index) ? std::optional(contacts_->contacts(place(index))) : std::nullopt;
}

std::shared_ptr<const FieldsReader> StoredRun::fields() const {
    if (!is_folder_) return frames_->fields();
    if (!is_there(name_of("fields.nc"))) return nullptr;
    return std::make_shared<const FieldsReader>(name_of("fields.nc"));
}

// A run that is still going on writes the contacts of a frame after the frame, so the last ones may be
// missing.
void StoredRun::leave_out_unfinished_contacts() {
    const std::size_t last = moments().size() - 1;
    if (last == 0 || !FolderLock::holder(path())) return;
    if (!contacts_->touches(place(last)).empty()) return;
    leave_out({last});
    news_.push_back(
        fmt::format("{}: the run goes on, and the last frame's contacts may not be written yet; it is "
                    "left out",
                    name_of("contacts.nc")));
}

void StoredRun::check_contacts_of_run() const {
    std::vector<Link> touches;
    State frame;
    for (std::size_t i = moments().size(); i-- > 0 && touches.empty();) {
        try {
            frame = grains(i);
            touches = contacts_->touches(place(i));
        } catch (const UserError&) {
            continue;  // the frame is damaged, which is reported when it is drawn
        }
    }
    check_contacts(scene_, touches, frame, name_of("contacts.nc"));
}

std::optional<Lack> StoredRun::measures_lack() const {
    const std::string name = name_of("measures.csv");
    const std::vector<double> times = measures_ ? measures_->all("time_s") : std::vector<double>();
    if (times.empty()) return Lack{.what = name + (is_there(name) ? ": holds no row" : ": is missing")};
    const double interval = times.size() > 1 ? times.back() - times[times.size() - 2] : 0,
                 end = moments().back().time;
    if (times.back() >= end - 1.5 * interval - 1e-9) return std::nullopt;
    return Lack{
        .what = fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s", name, times.back(), end),
        .some = true};
}

std::optional<MeasuredRow> StoredRun::measured_near(std::size_t index) const {
    if (restored_measures_) return restored_measures_;
    if (!is_folder_) return frames_->measured_near(number(index));
    const std::vector<double> times = measures_ ? measures_->all("time_s") : std::vector<double>();
    if (times.empty()) return std::nullopt;
    const double time = moments().at(index).time;
    std::size_t row = 0;
    for (std::size_t k = 1; k < times.size(); ++k)
        if (std::abs(times[k] - time) < std::abs(times[row] - time)) row = k;
    MeasuredRow measured{times[row], measures_->columns(), {}};
    for (std::size_t k = 0; k < measured.columns.size(); ++k)
        measured.values.push_back(measures_->values(k, row, row + 1).front());
    return measured;
}

std::optional<Lack> StoredRun::lack_of(Part part) const {
    if (!is_folder_) return std::nullopt;
    switch (part) {
        case Part::contacts:
            return contacts_lack_;
        case Part::measures:
            return measures_lack();
        case Part::wear:
            read_wear();
            return wear_lack_;
        case Part::outflow:
            read_outflow();
            return outflow_lack_;
    }
    return std::nullopt;
}

void StoredRun::read_wear() const {
    if (std::exchange(wear_read_, true) || !is_folder_) return;
    const std::string name = name_of("fields.nc");
    if (!is_there(name)) {
        wear_lack_ = Lack{.what = name + ": is missing"};
        return;
    }
    try {
        wear_.emplace(name, scene_);
    } catch (const UserError& fault) {
        wear_lack_ = Lack{.what = fault.what(), .damaged = true};
    }
}

void StoredRun::read_outflow() const {
    if (std::exchange(outflow_read_, true) || !is_folder_) return;
    const std::string name = name_of("outflow.csv");
    outflow_ = OutflowSums::read(name, scene_);
    if (!outflow_) outflow_lack_ = Lack{.what = name + ": is missing"};
}

std::shared_ptr<const std::vector<MeshWear>> StoredRun::worn(double time) const {
    read_wear();
    return wear_ ? wear_->until(time) : nullptr;
}

std::optional<FlowedOut> StoredRun::flowed_out(double time) const {
    read_outflow();
    return outflow_ ? std::optional(outflow_->until(time)) : std::nullopt;
}

std::vector<std::string> StoredRun::faults() const {
    if (!is_folder_) return {};
    std::vector<std::string> faults = faults_;
    if (const auto& lack = contacts_lack_; lack && (lack->some || lack->damaged))
        faults.push_back(lack->some ? lack->what + "; the last moments are without contacts" : lack->what);
    if (const auto lack = measures_lack())
        faults.push_back(lack->what + (lack->some ? "; it was cut off, or a row is damaged"
                                                  : ", so that what was measured is left out"));
    return faults;
}

}  // namespace grainreel
