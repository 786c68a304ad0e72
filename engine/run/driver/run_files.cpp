#include "engine/run/driver/run_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/files/run_names.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/measures.hpp"
#include "engine/run/resume/kept_files.hpp"

namespace grainreel {

double film_moments_bytes(const Scene& scene, const Plan& plan, std::int64_t frames) {
    constexpr double most_bytes = 100e6, bytes_a_grain = 68;
    if (!scene.output.trajectory) return 0;
    const double bytes = bytes_a_grain * static_cast<double>(frames) * static_cast<double>(plan.capacity);
    return scene.output.film_moments.value_or(bytes <= most_bytes) ? bytes : 0;
}

void count_contacts(State& frame, const RunFiles::Contacts& contacts) {
    frame.contact_number.assign(frame.size(), 0);
    const auto count = [&](std::int32_t id) {
        if (const auto row = frame.row_of(id)) ++frame.contact_number[*row];  // none for walls
    };
    for (const SavedContact& contact : contacts) {
        count(contact.first);
        count(contact.second);
    }
}

RunFiles::RunFiles(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                   const SimulatedBed& simulation, const std::string& program_version, bool keep_rows)
    : folder_(folder),
      info_(trajectory_info(scene, plan, program_version)),
      program_version_(program_version),
      rolls_(plan.rolls()),
      clock_(plan.clock),
      field_times_(plan.fields),
      measures_(folder / "measures.csv", simulation.measured()),
      departed_(scene),
      late_(plan.clock, scene.run.duration) {
    if (grains_leave(scene)) outflow_.emplace(folder / "outflow.csv");
    if (keep_rows) table_ = std::make_shared<MeasureTable>(measures_.columns());
    if (const auto sets = simulation.field_sets(); !sets.empty())
        fields_.emplace(folder / "fields.nc", sets, scene.title, program_version, file_facts(scene, true));
    if (plan.trajectory_every == 0) return;
    trajectory_.emplace(folder / "trajectory.nc", info_);
    if (scene.output.contacts)
        contacts_.emplace(folder / "contacts.nc", scene.title, program_version, info_.facts,
                          !info_.meshes.empty(), rolls_);
}

RunFiles::RunFiles(GoesOn, const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                   const SimulatedBed& simulation, const std::string& program_version, bool keep_rows)
    : folder_(folder),
      info_(trajectory_info(scene, plan, program_version)),
      program_version_(program_version),
      rolls_(plan.rolls()),
      clock_(plan.clock),
      field_times_(plan.fields),
      measures_(folder / "measures.csv", simulation.measured(), simulation.step()),
      departed_(scene),
      late_(plan.clock, scene.run.duration) {
    const double now = plan.clock.time(simulation.step());
    if (grains_leave(scene)) {
        outflow_.emplace(folder / "outflow.csv", now);
        if (std::optional<OutflowSums> before = OutflowSums::read(folder / "outflow.csv", scene))
            departed_ = std::move(*before);
    }
    if (keep_rows) table_ = std::make_shared<MeasureTable>(measures_.columns());
    take_over_rows(simulation);
    if (const auto sets = simulation.field_sets(); !sets.empty())
        fields_.emplace(folder / "fields.nc", sets, now);
    if (plan.trajectory_every == 0) return;
    const std::vector<std::int64_t> steps = steps_in_trajectory(folder / "trajectory.nc");
    const auto frames = static_cast<std::size_t>(
        std::lower_bound(steps.begin(), steps.end(), simulation.step()) - steps.begin());
    trajectory_.emplace(folder / "trajectory.nc", info_, frames);
    if (scene.output.contacts) contacts_.emplace(folder / "contacts.nc", frames);
}

// Reads the former rows of measures.csv, for plots and for the comparison of end and beginning.
void RunFiles::take_over_rows(const SimulatedBed& simulation) {
    const std::shared_ptr<const MeasureTable> rows = read_measures(folder_ / "measures.csv");
    if (!rows) return;
    const auto names = std::make_shared<const std::vector<std::string>>(simulation.measured());
    for (std::size_t row = 0; row < rows->rows(); ++row) {
        std::vector<double> values;
        for (std::size_t k = 0; k < names->size(); ++k)
            values.push_back(rows->values(k, row, row + 1).front());
        if (table_) table_->add(values);
        last_ = Measures(names, std::move(values));
        late_.add(*last_);
        if (!first_) first_ = last_;
    }
}

void RunFiles::keep_film_moments(std::size_t frames) {
    film_moments_.emplace(folder_ / kFilmMoments, info_, frames);
}

void RunFiles::keep_film_moments() {
    film_moments_.emplace(folder_ / kFilmMoments, info_);
}

void RunFiles::keep_key_moments() {
    key_moments_.emplace(folder_ / kKeyMoments, info_);
    key_contacts_.emplace(folder_ / kKeyContacts, info_.title, program_version_, info_.facts,
                          !info_.meshes.empty(), rolls_);
}

void RunFiles::keep_key_moments(std::int64_t step) {
    const std::vector<std::int64_t> steps = steps_in_trajectory(folder_ / kKeyMoments);
    const auto frames =
        static_cast<std::size_t>(std::lower_bound(steps.begin(), steps.end(), step) - steps.begin());
    key_moments_.emplace(folder_ / kKeyMoments, info_, frames);
    key_contacts_.emplace(folder_ / kKeyContacts, frames);
}

void RunFiles::add_key_moment(const State& frame, const Contacts& contacts) {
    const std::int64_t index = key_moments_->frames();
    key_moments_->write(frame);
    key_contacts_->write(index, contacts);
}

void RunFiles::add_frame(const State& frame, const Contacts& contacts) {
    const std::int64_t index = trajectory_->frames();
    trajectory_->write(frame);
    if (contacts_) contacts_->write(index, contacts);
}

void RunFiles::add_fields(const SimulatedBed& simulation) {
    const std::int64_t end = simulation.step();
    fields_->write(clock_.time(field_times_.begin_of_record(end)), clock_.time(end), simulation.fields());
}

void RunFiles::add_departures(SimulatedBed& simulation) {
    if (!outflow_) return;
    const std::vector<Departure> gone = simulation.take_departures();
    for (const Departure& one : gone) departed_.add(clock_.time(one.step), one.species, one.radius);
    outflow_->write(gone, clock_);
}

std::optional<FlowedOut> RunFiles::flowed_out(double time) const {
    return outflow_ ? std::optional(departed_.until(time)) : std::nullopt;
}

std::optional<std::int64_t> RunFiles::outflow_rows() const {
    return outflow_ ? std::optional(outflow_->rows()) : std::nullopt;
}

void RunFiles::add_measures(const Measures& measures) {
    measures_.write(measures);
    if (table_) table_->add(measures.values());
    if (!first_) first_ = measures;
    last_ = measures;
    late_.add(measures);
}

namespace {

constexpr int most_periods = 10;
constexpr double late_share = 0.1;  // share of a run without a drive that the means are taken over
constexpr double hair = 1e-3;       // tolerance as a share of a period, because rows are at whole steps

}  // namespace

int LateMeans::periods() const {
    const double cycles = rows_.empty() ? 0 : clock_.cycles(step_of(rows_.back()));
    return static_cast<int>(std::clamp(std::floor(cycles + hair), 0.0, double{most_periods}));
}

bool LateMeans::is_late(const Measures& row) const {
    const std::int64_t last = step_of(rows_.back()), step = step_of(row);
    if (step == last) return true;
    if (clock_.steps_per_period > 0) return clock_.cycles(last) - clock_.cycles(step) < periods() - hair;
    return clock_.time(last - step) < late_share * duration_;
}

void LateMeans::add(const Measures& row) {
    rows_.push_back(row);
    while (!is_late(rows_.front())) rows_.pop_front();
}

Measures LateMeans::means() const {
    std::vector<double> means;
    for (std::size_t column = 0; column < rows_.back().values().size(); ++column) {
        double sum = 0, count = 0;
        for (const Measures& row : rows_)
            if (std::isfinite(row.values()[column])) sum += row.values()[column], ++count;
        means.push_back(count > 0 ? sum / count : kUnknown);
    }
    return {std::make_shared<const std::vector<std::string>>(rows_.back().names()), std::move(means)};
}

std::string LateMeans::over() const {
    if (rows_.size() < 2) return "the last row";
    if (clock_.steps_per_period == 0) return fmt::format("the last {:.3g} s", late_share * duration_);
    return periods() == 1 ? "the last period" : fmt::format("the last {} periods", periods());
}

}  // namespace grainreel
