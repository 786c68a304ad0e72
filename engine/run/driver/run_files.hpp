// The files of one run that grow row by row (trajectory, contacts, measures, outflow), and means of the last
// measures.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/measure/measures.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"

namespace grainreel {

// Means of the measures over the last periods of a run, because a single row of a shaken bed depends on the
// phase at which it was taken.
class LateMeans {
  public:
    // Means over the last ten periods of the drive, or over all whole periods if there are fewer. Without a
    // drive they are over the last tenth of the run's duration (s).
    LateMeans(const Clock& clock, double duration) : clock_(clock), duration_(duration) {}

    // Adds a row. Rows come in order of time.
    void add(const Measures& row);
    // The mean of all rows that have a value. NaN where none has.
    Measures means() const;
    // The span of the means: "the last 10 periods", or "the last row" if not even one period has passed.
    std::string over() const;

  private:
    std::int64_t step_of(const Measures& row) const { return static_cast<std::int64_t>(row.at("step")); }
    int periods() const;                      // number of whole periods, with a drive
    bool is_late(const Measures& row) const;  // whether a row belongs to the span that ends at the last row

    Clock clock_;
    double duration_;
    std::deque<Measures> rows_;
};

// Bytes of film_moments.nc for `frames` frames; 0 if the scene keeps none.
double film_moments_bytes(const Scene& scene, const Plan& plan, std::int64_t frames);

class RunFiles {
  public:
    // Makes files with room for all grains that the plan expects. With `keep_rows`, the rows of measures.csv
    // also stay in memory (measures()). Throws RunError if a file cannot be made.
    RunFiles(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
             const SimulatedBed& simulation, const std::string& program_version, bool keep_rows);
    // Opens the files of a run that goes on in its folder from the simulation's step. Entries of this step
    // and later ones are cut off first. ready_files() must have checked the files. Throws UserError if they
    // lack earlier entries.
    struct GoesOn {};
    RunFiles(GoesOn, const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
             const SimulatedBed& simulation, const std::string& program_version, bool keep_rows);

    using Contacts = std::vector<SavedContact>;
    // Adds a frame with contact numbers, and the contacts of the same moment if the scene asks for them.
    void add_frame(const State& frame, const Contacts& contacts);
    // Begins a file of the frames that are handed out.
    void keep_film_moments();
    // Goes on with this file behind its first `frames` frames.
    void keep_film_moments(std::size_t frames);
    bool keeps_film_moments() const { return film_moments_.has_value(); }
    void add_film_moment(const State& frame) { film_moments_->write(frame); }
    // Begins the files of key moments and their contacts.
    void keep_key_moments();
    // Goes on with these files behind the key moments before a step.
    void keep_key_moments(std::int64_t step);
    bool keeps_key_moments() const { return key_moments_.has_value(); }
    void add_key_moment(const State& frame, const Contacts& contacts);
    void add_measures(const Measures& measures);
    // Fields of the observers, at the end of a record.
    bool has_fields() const { return fields_.has_value(); }
    void add_fields(const SimulatedBed& simulation);
    // Adds the grains that have left since the last call.
    void add_departures(SimulatedBed& simulation);

    std::int64_t trajectory_frames() const { return trajectory_ ? trajectory_->frames() : 0; }
    std::int64_t field_records() const { return fields_ ? fields_->records() : 0; }
    std::int64_t measures_rows() const { return measures_.rows(); }
    // The rows of measures.csv; null unless they are kept.
    std::shared_ptr<const MeasureTable> measures() const { return table_; }
    std::optional<std::int64_t> outflow_rows() const;
    // The grains that left until a time (s) that the run has reached, by outflow.csv; empty without that
    // file.
    std::optional<FlowedOut> flowed_out(double time) const;
    bool has_contacts() const { return contacts_.has_value(); }
    const std::optional<Measures>& first_measures() const { return first_; }
    const std::optional<Measures>& last_measures() const { return last_; }
    const LateMeans& late_measures() const { return late_; }

  private:
    void take_over_rows(const SimulatedBed& simulation);

    std::filesystem::path folder_;
    TrajectoryInfo info_;  // for the trajectory, the frames handed out, and the key moments
    std::string program_version_;
    bool rolls_;  // whether contacts resist rolling
    std::optional<TrajectoryWriter> trajectory_, film_moments_, key_moments_;
    std::optional<ContactsWriter> contacts_, key_contacts_;
    Clock clock_;
    FieldTimes field_times_;
    std::optional<FieldsWriter> fields_;
    MeasuresWriter measures_;
    std::optional<OutflowWriter> outflow_;  // only if grains may leave
    OutflowSums departed_;
    std::shared_ptr<MeasureTable> table_;
    std::optional<Measures> first_, last_;
    LateMeans late_;
};

// Sets the contact numbers of a frame from all contacts that carry force at its moment.
void count_contacts(State& frame, const RunFiles::Contacts& contacts);

}  // namespace grainreel
