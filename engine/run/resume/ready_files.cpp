#include "engine/run/resume/ready_files.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/outflow_record.hpp"
#include "engine/files/run_names.hpp"
#include "engine/files/trajectory.hpp"
#include "engine/files/trajectory_info.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

class Ready {
  public:
    Ready(const fs::path& run, const Scene& scene, const Plan& plan, const Simulation& simulation,
          const std::string& version, FormerRun& former)
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
        OutflowRecord::read(file, scene_);
        // With the clock of an earlier run its grains have left too, and are in its file.
        if (!scene_.start.keep_clock && kept.rows != simulation_.traffic().left)
            throw UserError(fmt::format(
                "{}: has {} grains up to {:.6g} s, where {} have left; the run cannot go on without them",
                file.string(), kept.rows, now(), simulation_.traffic().left));
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

    // One of which nothing is kept may be damaged: a new one takes its place.
    void film_moments(std::size_t frames) {
        if (!is_there(run_ / kFilmMoments)) return;
        if (frames == 0)
            const TrajectoryWriter none(former_.new_file(kFilmMoments), info_);
        else
            moments(kFilmMoments, frames);
    }

    // A run does without them where they are damaged.
    ReadyFiles key_moments() {
        const bool moments_there = is_there(run_ / kKeyMoments),
                   contacts_there = is_there(run_ / kKeyContacts);
        if (!moments_there && !contacts_there) return {};  // of a run without a page
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
        const TrajectoryReader whole(file);  // says what is wrong
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
    const Simulation& simulation_;
    const TrajectoryInfo info_;
    FormerRun& former_;
};

}  // namespace

ReadyFiles ready_files(const fs::path& run, const Scene& scene, const Plan& plan,
                       const Simulation& simulation, std::optional<std::size_t> frames,
                       const std::string& program_version, FormerRun& former) {
    Ready ready(run, scene, plan, simulation, program_version, former);
    ready.measures();
    ready.outflow();
    ready.fields();
    ready.trajectory();
    if (frames) ready.film_moments(*frames);
    return ready.key_moments();
}

}  // namespace grainreel
