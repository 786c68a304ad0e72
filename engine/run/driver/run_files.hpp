// The files of one run that grow while it goes on: trajectory, contacts, measures, outflow; and means of the
// last measures.
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
#include "engine/files/trajectory.hpp"
#include "engine/measure/measures.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Means of the measures over the last periods of a run, because a single row of a shaken bed depends on where
// in its period it was taken.
class LateMeans {
  public:
    // Over the last ten periods of the drive, or as many whole ones as there are; without a drive over the
    // last tenth of the run's duration (s).
    LateMeans(const Clock& clock, double duration) : clock_(clock), duration_(duration) {}

    // Rows come one after the other, with their step.
    void add(const Measures& row);
    // The mean of all rows that have a value. NaN where none has.
    Measures means() const;
    // What they are means of: "the last 10 periods"; "the last row" where not even one period has passed.
    std::string over() const;

  private:
    std::int64_t step_of(const Measures& row) const { return static_cast<std::int64_t>(row.at("step")); }
    int periods() const;                      // whole ones, with a drive
    bool is_late(const Measures& row) const;  // as seen from the last row

    Clock clock_;
    double duration_;
    std::deque<Measures> rows_;
};

// Bytes of film_moments.nc for so many frames that are handed out; 0 where the scene keeps none.
double film_moments_bytes(const Scene& scene, const Plan& plan, std::int64_t frames);

class RunFiles {
  public:
    // With room for all grains that the plan expects. keep_rows: those of measures.csv stay in memory too
    // (measures()). Throws RunError when a file cannot be made.
    RunFiles(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
             const Simulation& simulation, const std::string& program_version, bool keep_rows);
    // For a run that goes on in its folder from where the simulation is: what its files have of that step and
    // later ones is cut off first. ready_files() has looked at them. Throws UserError where they
    // lack something of what was before.
    struct GoesOn {};
    RunFiles(GoesOn, const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
             const Simulation& simulation, const std::string& program_version, bool keep_rows);

    using Contacts = std::vector<SavedContact>;
    // The frame, which has contact numbers, and the contacts of the same moment when the scene asks for them.
    void add_frame(const Frame& frame, const Contacts& contacts);
    // From now on: frames that are handed out, in a file of their own.
    void keep_film_moments();
    // Behind the first `frames` of them.
    void keep_film_moments(std::size_t frames);
    bool keeps_film_moments() const { return film_moments_.has_value(); }
    void add_film_moment(const Frame& frame) { film_moments_->write(frame); }
    // From now on: key moments with their contacts.
    void keep_key_moments();
    // Behind those before a step.
    void keep_key_moments(std::int64_t step);
    bool keeps_key_moments() const { return key_moments_.has_value(); }
    void add_key_moment(const Frame& frame, const Contacts& contacts);
    void add_measures(const Measures& measures);
    // What observers give on grids, at the end of a record.
    bool has_fields() const { return fields_.has_value(); }
    void add_fields(const Simulation& simulation);
    // Who has left since the last call.
    void add_departures(Simulation& simulation);

    std::int64_t trajectory_frames() const { return trajectory_ ? trajectory_->frames() : 0; }
    std::int64_t field_records() const { return fields_ ? fields_->records() : 0; }
    std::int64_t measures_rows() const { return measures_.rows(); }
    // The rows again; null unless they are kept.
    std::shared_ptr<const MeasureTable> measures() const { return table_; }
    std::optional<std::int64_t> outflow_rows() const;
    // How much of outflow.csv until a time (s) that the run has reached; none without such a file.
    std::optional<FlowedOut> flowed_out(double time) const;
    bool has_contacts() const { return contacts_.has_value(); }
    const std::optional<Measures>& first_measures() const { return first_; }
    const std::optional<Measures>& last_measures() const { return last_; }
    const LateMeans& late_measures() const { return late_; }

  private:
    void take_over_rows(const Simulation& simulation);

    std::filesystem::path folder_;
    TrajectoryInfo info_;  // of the trajectory, of what is handed out, and of key moments
    std::string program_version_;
    std::optional<TrajectoryWriter> trajectory_, film_moments_, key_moments_;
    std::optional<ContactsWriter> contacts_, key_contacts_;
    Clock clock_;
    FieldTimes field_times_;
    std::optional<FieldsWriter> fields_;
    MeasuresWriter measures_;
    std::optional<OutflowWriter> outflow_;  // where grains may leave
    OutflowSums departed_;
    std::shared_ptr<MeasureTable> table_;
    std::optional<Measures> first_, last_;
    LateMeans late_;
};

// Contact numbers of the frame, from all contacts that carry force then.
void count_contacts(Frame& frame, const RunFiles::Contacts& contacts);

}  // namespace grainreel
