#include "engine/handover/bring_back.hpp"

#include <fmt/format.h>
#include <chrono>
#include <thread>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/grain_table.hpp"
#include "engine/handover/deck_dump.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/grain_count.hpp"
#include "engine/handover/handed_grains.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/peer_process.hpp"
#include "engine/handover/returned_health.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/import/arrival.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr const char* made_names[] = {"measures.csv", "outflow.csv", "final.csv", "trajectory.nc"};

bool is_newer(const fs::path& made, const fs::path& dump) {
    std::error_code missing;
    const auto when = fs::last_write_time(made, missing);
    return !missing && when >= fs::last_write_time(dump, missing) && !missing;
}

}  // namespace

std::unique_ptr<ReturningFolder> ReturningFolder::take(const fs::path& folder, const std::string& name) {
    const fs::path path = folder / name;
    std::error_code failed;
    fs::create_directory(path, failed);
    if (!is_folder(path)) throw RunError("{}: cannot be made: {}", path.string(), failed.message());
    std::optional<FolderLock> lock = FolderLock::take(path, "");
    if (!lock || !lock->is_there()) return nullptr;
    // Removes what a killed process has left.
    for (const fs::directory_entry& one : fs::directory_iterator(path, failed))
        if (one.path().filename() != ".lock") fs::remove_all(one.path(), failed);
    return std::unique_ptr<ReturningFolder>(new ReturningFolder(std::move(*lock)));
}

ReturningFolder::~ReturningFolder() {
    std::error_code ignored;
    fs::remove_all(path(), ignored);
}

void ReturningFolder::move_out() const {
    for (const char* name : made_names)
        if (is_there(path() / name)) fs::rename(path() / name, path().parent_path() / name);
}

namespace {

// Waits while another process brings the run back. Returns none if the watcher returns false.
std::unique_ptr<ReturningFolder> returning(const fs::path& folder,
                                           const std::function<bool(double)>& watcher) {
    while (true) {
        if (auto made = ReturningFolder::take(folder)) return made;
        if (!watcher(0)) return nullptr;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

// Throws where nothing of the run can be shown: RunError with the reason if its job has failed, else
// UserError.
[[noreturn]] void fail_without_moment(const fs::path& folder, const HandoverFacts& facts,
                                      const std::string& what, const std::string& advice) {
    const JobEnd job = job_end(folder, facts);
    if (!job.failure.empty()) throw RunError("{}: {}; {}", facts.dump.string(), what, job.failure);
    throw UserError("{}: {}{}", facts.dump.string(), what, advice);
}

// What the user should know of a run that was brought back before.
std::vector<std::string> news_of_former(const fs::path& folder, const HandoverFacts& facts) {
    const TrajectoryReader former(folder / "trajectory.nc");
    if (former.frames() == 0) return {};
    const State last = former.read_moment(former.frames() - 1);
    if (last.step >= facts.last) return {};
    return {came_so_far(folder, facts, last.time, static_cast<double>(facts.last) * facts.step)};
}

// Reads the whole dump. Returns false if the watcher does.
bool read_back(ReturnedRun& run, const HandoverFacts& facts, const std::function<bool(double)>& watcher,
               BroughtBack& back) {
    try {
        while (run.take_next())
            if (!watcher(static_cast<double>(run.frames()) /
                         static_cast<double>(std::max<std::int64_t>(run.frames(), facts.dumps))))
                return false;
    } catch (const RunError& unsound) {
        if (run.last() == nullptr) throw;
        back.news.emplace_back(unsound.what());
    }
    return true;
}

}  // namespace

BroughtBack bring_back(const fs::path& folder, const std::string& version,
                       const std::function<bool(double)>& watcher) {
    const HandoverFacts facts = read_handover(folder);
    if (!is_plain(facts.dump))
        fail_without_moment(folder, facts, "is not there",
                            fmt::format(", so {} has not run yet; run it: sh {}", name_of(facts.engine),
                                        shell_word((folder / "run.sh").string())));
    BroughtBack back;
    if (is_newer(folder / "trajectory.nc", facts.dump)) {
        back.news = news_of_former(folder, facts);
        return back;
    }
    const Scene scene = read_scene(folder / "scene.toml", {}, measurable_in);
    const Plan plan = make_plan(scene);
    const std::unique_ptr<ReturningFolder> made = returning(folder, watcher);
    if (!made || is_newer(folder / "trajectory.nc", facts.dump)) return back;
    {
        ReturnedRun run(made->path(), scene, plan, facts, version);
        if (!read_back(run, facts, watcher, back)) return back;
        if (run.last() == nullptr) fail_without_moment(folder, facts, "has no whole moment", " so far");
        back.frames = run.frames();
        back.until = run.last()->time;
        back.whole = run.last()->step >= facts.last;
        RunJson record;
        run.close(record);
        if (std::string text = run.overlap_text(); !text.empty()) back.news.push_back(std::move(text));
    }
    made->move_out();
    if (!back.whole) back.news.push_back(came_so_far(folder, facts, back.until, plan.clock.time(facts.last)));
    return back;
}

namespace {

TrajectoryInfo info_of(const Scene& scene, const Plan& plan, const std::string& version) {
    TrajectoryInfo info = trajectory_info(scene, plan, version);
    info.contact_numbers = false;  // a dump does not have them
    info.orientation = false;
    return info;
}

ArrivalFacts arrival_facts(const Scene& scene, const Plan& plan, const HandoverFacts& facts,
                           const std::string& version) {
    ArrivalFacts all;
    all.header = info_of(scene, plan, version);
    all.clock = plan.clock;
    all.in_container = facts.frame == ReferenceFrame::container;
    // ReturnedHealth fills this column. In our own runs an observer in the step loop does.
    all.more_columns = {"largest_overlap"};
    return all;
}

}  // namespace

struct ReturnedRun::Impl {
    Impl(const std::filesystem::path& folder_in, const Scene& scene_in, const Plan& plan_in,
         const HandoverFacts& facts_in, const std::string& version)
        : folder(folder_in),
          scene(scene_in),
          plan(plan_in),
          facts(facts_in),
          dump(facts.dump),
          count(scene, facts.dump.string()),
          health(scene, plan),
          arrival(folder, scene, arrival_facts(scene, plan, facts, version)) {
        if (scene.container.outlet && !scene.container.tray) outflow.emplace(folder / "outflow.csv");
    }

    // Our ids count from 0, the engine's from 1. There the glued grains, which are not dumped, stand between
    // those of the start and those that are fed.
    std::int32_t id_of(std::int64_t there) const {
        const std::int64_t id = there <= facts.grains ? there - 1 : there - 1 - facts.glued;
        if (id < 0)
            throw UserError("{}: has an atom {}, which is none of the scene's", facts.dump.string(), there);
        return static_cast<std::int32_t>(id);
    }

    // The frame of the dump with our steps and ids, in the room.
    State ours(State frame) const {
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const std::int32_t species = frame.species[i];
            if (species < 0 || species >= std::ssize(scene.species) || !(frame.radius[i] > 0))
                throw UserError(
                    "{}: step {}: atom {} has type {} and radius {}, which none of the "
                    "scene's grains has",
                    facts.dump.string(), frame.step, frame.id[i], std::int64_t{species} + 1, frame.radius[i]);
            frame.id[i] = id_of(frame.id[i]);
        }
        frame.step -= facts.shift;
        frame.time = plan.clock.time(frame.step);
        arrival.complete(frame);
        return frame;
    }

    void note_outflow(const std::vector<std::size_t>& left, std::int64_t now) {
        if (!outflow || left.empty()) return;
        std::vector<Departure> gone;
        for (const std::size_t row : left) {
            Departure one;
            one.step = now;
            one.id = last->id[row];
            one.species = last->species[row];
            one.radius = last->radius[row];
            one.position = last->position[row];
            one.velocity = last->velocity[row];
            one.spin = last->spin[row];
            gone.push_back(one);
        }
        outflow->write(gone, plan.clock);
    }

    const std::filesystem::path folder;
    const Scene& scene;
    const Plan& plan;
    const HandoverFacts facts;
    DeckDump dump;
    const GrainCount count;
    ReturnedHealth health;
    Arrival arrival;
    std::optional<OutflowWriter> outflow;
    std::optional<State> last;
};

ReturnedRun::ReturnedRun(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                         const HandoverFacts& facts, const std::string& version)
    : impl_(std::make_unique<Impl>(folder, scene, plan, facts, version)) {}

ReturnedRun::~ReturnedRun() = default;

bool ReturnedRun::take_next() {
    Impl& m = *impl_;
    std::optional<State> there = m.dump.next();
    if (!there) return false;
    // A run that continued from the engine's restart file writes its first moment once more.
    if (m.last && there->step - m.facts.shift <= m.last->step) return true;
    if (!m.last) {
        const Container& container = m.scene.container;
        const HandedGrains handed(m.facts.dump.parent_path() / data_name, m.facts.dump.string());
        handed.check_first(*there, container.periodic_depth ? container.depth : 0);
    }
    State frame = m.ours(std::move(*there));
    if (m.last) check_unchanged(*m.last, frame, m.facts.dump.string());
    const GrainCount::Change change = m.count.compare(m.last ? &*m.last : nullptr, frame);
    const double overlap = m.health.look(frame);
    m.note_outflow(change.left, frame.step);
    m.arrival.take(frame, {}, {overlap});
    m.last = std::move(frame);
    return true;
}

bool ReturnedRun::dump_is_shorter() const {
    return impl_->dump.is_shorter();
}

void ReturnedRun::read_anew() {
    impl_->dump.read_anew();
}

void ReturnedRun::close(RunJson& record) {
    Impl& m = *impl_;
    record.trajectory_frames = m.arrival.frames();
    record.measures_rows = m.arrival.rows();
    if (!m.last) return;
    if (m.health.deepest().share > 0) record.deepest = m.health.deepest();
    record.steps = m.last->step;
    record.simulated = m.last->time;
    record.final_table = write_grain_table(m.folder / kFinalTable, *m.last);
}

std::string ReturnedRun::overlap_text() const {
    return impl_->health.overlap_text();
}

std::int64_t ReturnedRun::frames() const {
    return impl_->arrival.frames();
}

const State* ReturnedRun::last() const {
    return impl_->last ? &*impl_->last : nullptr;
}

}  // namespace grainreel
