#include "engine/run/resume/kept_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/walls/wall_forces_observer.hpp"
#include "engine/measure/walls/wear_observer.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Whether the rising `steps` contain each step of the rhythm from `first` up to, but not including, `end`.
bool has_all(const std::vector<std::int64_t>& steps, const Rhythm& rhythm, const Clock& clock,
             std::int64_t first, std::int64_t end) {
    for (std::int64_t step = rhythm.next(first, clock); step < end; step = rhythm.next(step + 1, clock))
        if (!std::binary_search(steps.begin(), steps.end(), step)) return false;
    return true;
}

bool has_all_fields(const fs::path& file, const Plan& plan, std::int64_t first, std::int64_t step) {
    std::size_t records = 0;
    for (std::int64_t end = plan.fields.next_end(first + 1); end < step; end = plan.fields.next_end(end + 1))
        ++records;
    return FieldsWriter::records_before(file, plan.clock.time(step)) == records;
}

// Whether contacts.nc has the contacts of all frames before the step.
bool has_all_contacts(const fs::path& run, std::int64_t step) {
    const std::vector<std::int64_t> steps = steps_in_trajectory(run / "trajectory.nc");
    const auto frames = std::lower_bound(steps.begin(), steps.end(), step) - steps.begin();
    return frames == 0 || ContactsReader(run / "contacts.nc").has_all(static_cast<std::size_t>(frames - 1));
}

}  // namespace

std::vector<std::int64_t> steps_in_trajectory(const fs::path& file) {
    std::vector<std::int64_t> steps;
    if (!is_there(file)) return steps;
    try {
        const TrajectoryReader reader(file);
        for (std::size_t k = 0; k < reader.frames(); ++k) steps.push_back(reader.read_moment(k).step);
    } catch (const UserError&) {
        return steps;  // the steps before the damage
    }
    return steps;
}

std::vector<std::int64_t> steps_in_measures(const fs::path& file) {
    std::vector<std::int64_t> steps;
    const std::shared_ptr<const MeasureTable> table = read_measures(file);
    if (!table) return steps;
    for (const double step : table->all("step")) steps.push_back(static_cast<std::int64_t>(step));
    return steps;
}

bool keeps_fields(const Scene& scene) {
    const std::vector<std::string> wanted = scene.instruments();
    const auto wants = [&](const char* instrument) { return contains(wanted, instrument); };
    const bool presses =
        wants(observers::WallForces::instrument) && !PressureProfile(scene).fields().fields.empty();
    return scene.output.fields.wanted() || presses ||
           (wants(observers::Wear::instrument) && !scene.meshes.empty());
}

void check_files_of_run(const fs::path& run, const Scene& scene, const Plan& plan) {
    const auto need = [&](const char* name, bool wanted) {
        if (wanted && !is_there(run / name))
            throw UserError("{}: is missing, so the run cannot go on; run its scene.toml again",
                            (run / name).string());
    };
    need("measures.csv", true);
    need("trajectory.nc", plan.trajectory_every > 0);
    need("contacts.nc", plan.trajectory_every > 0 && scene.output.contacts);
    need("fields.nc", keeps_fields(scene));
    need("outflow.csv", grains_leave(scene));
    if (!read_measures(run / "measures.csv"))
        throw UserError("{}: cannot be read, so the run cannot go on; run its scene.toml again",
                        (run / "measures.csv").string());
    // Each reader throws if its file cannot be read.
    if (plan.trajectory_every > 0) TrajectoryReader reader(run / "trajectory.nc");
    if (plan.trajectory_every > 0 && scene.output.contacts) ContactsReader reader(run / "contacts.nc");
    if (scene.output.fields.wanted()) FieldsWriter::records_before(run / "fields.nc", 0);
}

std::int64_t reached_step(const fs::path& run, std::int64_t last_checkpoint) {
    const std::vector<std::int64_t> rows = steps_in_measures(run / "measures.csv");
    return rows.empty() ? last_checkpoint : std::max(last_checkpoint, rows.back());
}

bool files_reach(const fs::path& run, const Scene& scene, const Plan& plan, std::int64_t first,
                 std::int64_t step) {
    if (scene.output.fields.wanted() && !has_all_fields(run / "fields.nc", plan, first, step)) return false;
    if (plan.trajectory_every > 0 && scene.output.contacts && !has_all_contacts(run, step)) return false;
    const Rhythm trajectory(plan.trajectory_every, plan.trajectory_periods),
        measures(plan.measures_every, plan.measures_periods);
    return (plan.trajectory_every == 0 ||
            has_all(steps_in_trajectory(run / "trajectory.nc"), trajectory, plan.clock, first, step)) &&
           has_all(steps_in_measures(run / "measures.csv"), measures, plan.clock, first, step);
}

namespace fs = std::filesystem;

namespace {

class Ready {
  public:
    Ready(const fs::path& run, const Scene& scene, const Plan& plan, const SimulatedBed& simulation,
          const std::string& version, FormerFiles& former)
        : run_(run),
          scene_(scene),
          plan_(plan),
          simulation_(simulation),
          info_(trajectory_info(scene, plan, version)),
          former_(former) {}

    void measures() {
        former_.cut("measures.csv", MeasuresWriter::bytes_before(run_ / "measures.csv",
                                                                 simulation_.measured(), simulation_.step()));
    }

    void outflow() {
        if (!grains_leave(scene_)) return;
        const fs::path file = run_ / "outflow.csv";
        const OutflowWriter::Kept kept = OutflowWriter::kept_until(file, now());
        OutflowSums::read(file, scene_);
        // If the scene keeps the clock of an earlier run, the grains that left in that run are in that run's
        // file.
        if (!scene_.start.keep_clock && kept.rows != simulation_.traffic().left)
            throw UserError(
                "{}: has {} grains up to {:.6g} s, where {} have left; the run cannot go on without them",
                file.string(), kept.rows, now(), simulation_.traffic().left);
        former_.cut("outflow.csv", kept.bytes);
    }

    void fields() {
        const auto sets = simulation_.field_sets();
        if (!sets.empty())
            former_.cut("fields.nc", FieldsWriter::kept_before(run_ / "fields.nc", sets, now()));
    }

    void trajectory() {
        if (plan_.trajectory_every == 0) return;
        const std::size_t frames = frames_before(run_ / "trajectory.nc");
        moments("trajectory.nc", frames);
        if (scene_.output.contacts)
            former_.cut("contacts.nc", ContactsWriter::kept_of(run_ / "contacts.nc", frames));
    }

    // If no frames are kept, the file may be damaged, because a new one replaces it.
    void film_moments(std::size_t frames) {
        if (!is_there(run_ / kFilmMoments)) return;
        if (frames == 0)
            const TrajectoryWriter none(former_.new_file(kFilmMoments), info_);
        else
            moments(kFilmMoments, frames);
    }

    // If the key moments are damaged, the run goes on without them.
    ReadyFiles key_moments() {
        const bool moments_there = is_there(run_ / kKeyMoments),
                   contacts_there = is_there(run_ / kKeyContacts);
        if (!moments_there && !contacts_there) return {};  // the run has no page
        if (!moments_there || !contacts_there)
            return {false, fmt::format("{} is not there",
                                       (run_ / (moments_there ? kKeyContacts : kKeyMoments)).string())};
        try {
            const std::size_t frames = frames_before(run_ / kKeyMoments);
            const KeptRecords contacts = ContactsWriter::kept_of(run_ / kKeyContacts, frames);
            moments(kKeyMoments, frames);
            former_.cut(kKeyContacts, contacts);
        } catch (const UserError& problem) {
            return {false, problem.what()};
        }
        return {true, ""};
    }

  private:
    double now() const { return plan_.clock.time(simulation_.step()); }

    std::size_t frames_before(const fs::path& file) const {
        const TrajectoryReader whole(file);  // throws and says what is wrong
        const std::vector<std::int64_t> steps = steps_in_trajectory(file);
        return static_cast<std::size_t>(std::lower_bound(steps.begin(), steps.end(), simulation_.step()) -
                                        steps.begin());
    }

    void moments(const char* name, std::size_t frames) {
        const bool fits = TrajectoryWriter::goes_on_with(info_, run_ / name);
        const KeptRecords kept = TrajectoryWriter::kept_of(run_ / name, frames);
        if (fits)
            former_.cut(name, kept);
        else
            TrajectoryWriter::write_again(run_ / name, frames, former_.new_file(name), info_);
    }

    const fs::path& run_;
    const Scene& scene_;
    const Plan& plan_;
    const SimulatedBed& simulation_;
    const TrajectoryInfo info_;
    FormerFiles& former_;
};

}  // namespace

ReadyFiles ready_files(const fs::path& run, const Scene& scene, const Plan& plan,
                       const SimulatedBed& simulation, std::optional<std::size_t> frames,
                       const std::string& program_version, FormerFiles& former) {
    Ready ready(run, scene, plan, simulation, program_version, former);
    ready.measures();
    ready.outflow();
    ready.fields();
    ready.trajectory();
    if (frames) ready.film_moments(*frames);
    return ready.key_moments();
}

}  // namespace grainreel
