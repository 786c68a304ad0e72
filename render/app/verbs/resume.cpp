// The verb `resume` continues a run that was broken off, or that should be longer, in its folder.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/former_files.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/measure/columns.hpp"
#include "engine/questions/discharge.hpp"
#include "engine/run/driver/agenda.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/run/resume/resume_point.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/report.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/run/movie_job.hpp"
#include "render/film/run/peer_job.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

class Resume final : public Verb {
  public:
    Resume()
        : Verb("resume", "Go on with a run that was broken off, or make a finished one longer",
               fmt::format("The run goes on in its own folder, from its last checkpoint, with the same bits "
                           "as in one go. Its files have no\n"
                           "gap and no row twice. The film is drawn again from the moments that were "
                           "kept.\n"
                           "{}",
                           exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser.add_option("RUN", run_, "Folder of the run")->required()->type_name("DIR");
        CLI::Option* until =
            add_time(parser, "--until", until_, "New end of the run [run.duration of its scene]");
        add_time(parser, "--for", more_, "Time to add to what the run has reached")->excludes(until);
        parser
            .add_option("--accept", accept_,
                        "New value of a key from now on, as in drive.g_level=4 or contact.friction=0.2; "
                        "without VALUE, the one in scene.toml; may be repeated")
            ->type_name("KEY[=VALUE]")
            ->expected(1)
            ->take_all();
        parser.add_flag("--no-film", no_film_, "Leave the film as it is");
        parser.add_flag("--no-report", no_page_, "Leave report.html as it is");
        parser.add_option("--threads", threads_, "Number of threads [that of its scene]")
            ->type_name("N")
            ->check(CLI::Range(1, 1024));
        add_gl(parser, film_.gl);
        parser.get_option("--gl")->excludes(parser.get_option("--no-film"));
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        if (!no_page_) film_.page = page_of_ended_run();
        const fs::path folder = folder_of_run(run_);
        if (is_handover(folder))
            throw UserError("{}: was handed over; go on with: sh {} --continue", folder.string(),
                            shell_word((folder / "run.sh").string()));
        scene_file(folder);
        check_all_plain(folder);
        std::shared_ptr<FolderLock> lock = locked(folder);
        if (is_handover(folder / ReturnedRun::kFolder)) return go_on_elsewhere(folder, lock, reporter);
        put_back_former(folder, reporter);
        if (is_only_page_missing(folder)) return make_missing_page(folder, reporter);
        FilmedScene scene = scene_to_go_on(folder, {});
        Plan plan = plan_to_go_on(scene, folder);
        std::vector<AcceptedChange> changes;
        if (!accept_.empty()) {
            changes = accepted_changes(kept_checkpoints(folder).back().file, scene, plan, accepted_keys());
            scene = scene_to_go_on(folder, undone(changes));
            plan = plan_to_go_on(scene, folder);
        }
        film_.out = folder;
        film_.film = !no_film_ && has_film(scene, folder);
        film_.frames = film_.film && is_there(folder / "frames");
        const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
        const int threads = plan_threads(processors, film_.film, scene.grains()).engine;
        ResumePoint point = find_resume_point(scene, plan, folder, threads,
                                              film_.film ? reach_of_film(scene, plan) : FramesReach());
        const RunJson former = read_run_json(folder / "run.json").record;
        point.accepted = former.accepted;
        point.deepest = former.deepest;
        point.settled = former.settled;
        if (!changes.empty()) take_up(changes, folder, scene, plan, point, threads);
        reporter.info(fmt::format("{}: goes on from {:.6g} s to {:.6g} s", folder.string(),
                                  plan.clock.time(point.simulation.step()), scene.run.duration));
        if (!point.held_back.empty()) reporter.info("note: " + point.held_back);
        for (const AcceptedChange& change : changes)
            reporter.info(
                fmt::format("'{}' is {} from there on; it was {}", change.key, change.now, change.then));
        name_as_before(scene, folder);
        MovieJob movie(film_, reporter, scene, plan, std::move(point), std::move(lock));
        const FolderJob::Ended ended = movie.run();
        if (ended.exit_status == 0 && ended.folder)
            for (const std::string& line : discharge_lines(*ended.folder, scene)) reporter.info(line);
        return tell_folder(ended, film_);
    }

  private:
    static fs::path scene_file(const fs::path& folder) {
        return file_of_run(
            folder, "scene.toml",
            "give the folder of a run of `movie`; a film that `render` or `compare` made cannot "
            "go on");
    }

    // Continues a run of `movie --engine`: the other engine goes on from its own restart file.
    int go_on_elsewhere(const fs::path& folder, std::shared_ptr<FolderLock> lock, Reporter& reporter) {
        if (until_ || more_ || threads_ || !accept_.empty())
            throw UserError("{}: another engine ran this, and its deck cannot be changed; leave out {}",
                            folder.string(),
                            until_     ? "--until"
                            : more_    ? "--for"
                            : threads_ ? "--threads"
                                       : "--accept");
        FilmedScene scene = read_filmed_scene(scene_file(folder), {}, measurable_in);
        const Plan plan = plan_with_film(scene);
        film_.out = folder;
        film_.film = !no_film_ && has_film(scene, folder);
        film_.frames = film_.film && is_there(folder / "frames");
        name_as_before(scene, folder);
        PeerJob run(film_, reporter, scene, plan, std::move(lock));
        return tell_folder(run.run(), film_);
    }

    // Locks the folder, so that from here on no other process changes the run.
    std::shared_ptr<FolderLock> locked(const fs::path& folder) const {
        if (std::optional<FolderLock> lock = FolderLock::take(folder, command))
            return std::make_shared<FolderLock>(std::move(*lock));
        throw UserError("{}: is in use by {}; wait until it has ended", folder.string(),
                        FolderLock::holder(folder).value_or("another process"));
    }

    static void put_back_former(const fs::path& folder, Reporter& reporter) {
        if (!FormerFiles::is_kept(folder)) return;
        FormerFiles::put_back(folder);
        reporter.info(fmt::format(
            "{}: an earlier `resume` did not come past the run's former end; the run is as it was before it",
            folder.string()));
    }

    // Whether a run has come to its end, should not be longer, and lacks nothing but its page.
    // lacks_only_page() finds that in run.json. In runs of older versions run.json does not say it, so there
    // the files tell.
    bool is_only_page_missing(const fs::path& folder) const {
        if (until_ || more_ || !accept_.empty()) return false;
        const RunJson record = read_run_json(folder / "run.json").record;
        const bool complete = record.status == RunStatus::complete;
        return lacks_only_page(record) ||
               (complete && !no_page_ && is_there(folder / kKeyMoments) && !is_there(folder / kPageName));
    }

    int make_missing_page(const fs::path& folder, Reporter& reporter) const {
        std::string page;
        if (film_.page) {
            reporter.info(fmt::format("{}: only its page is missing", folder.string()));
            const auto go_on = [&](double) { return reporter.stop_signal() == 0; };
            page = film_.page(folder, go_on).value_or("");
            if (page.empty()) return signal_base + reporter.stop_signal();
        }
        complete_run_json(folder / "run.json", page);
        reporter.info(fmt::format("wrote {}: {}run.json", folder.string(), page.empty() ? "" : page + ", "));
        return tell_folder({0, folder}, film_);
    }

    std::vector<std::string> accepted_keys() const {
        std::vector<std::string> keys;
        for (const std::string& one : accept_) keys.push_back(one.substr(0, one.find('=')));
        return keys;
    }

    // "contact.friction=0.2" stands for the friction of each pair; the scene of a run has a key for each of
    // them.
    static Assignments spelled_out(const std::string& one, const fs::path& file) {
        const std::size_t equals = one.find('=');
        const std::string key = one.substr(0, equals), value = one.substr(equals);
        if (key != "contact.friction" && key != "contact.rolling_friction") return {{one, "--accept"}};
        const FilmedScene scene = read_filmed_scene(file, {}, measurable_in);
        const std::size_t species = scene.species.size();
        const std::size_t pairs = species * (species + 3) / 2 + scene.contact.mesh.size();
        Assignments all;
        for (std::size_t k = 0; k < pairs; ++k)
            all.push_back({fmt::format("contact.pair[{}].{}{}", k, key.substr(sizeof "contact." - 1), value),
                           "--accept"});
        return all;
    }

    // Applies changes of the scene from the checkpoint on. The checkpoint is saved again with the changed
    // scene, so that moments after it are brought back as they were computed.
    void take_up(const std::vector<AcceptedChange>& changes, const fs::path& folder, FilmedScene& scene,
                 Plan& plan, ResumePoint& point, int threads) const {
        const double time = plan.clock.time(point.simulation.step());
        FilmedScene changed = scene_to_go_on(folder, {});
        const std::string words = words_of_changes(scene, changed, changes);
        changed.drive = drive_changed_at(time, scene, changed, changes);
        add_caption_of_change(changed, time, words);
        const Plan changed_plan = plan_to_go_on(changed, folder);
        check_overlap_stays(scene, plan, changed_plan);
        point.simulation =
            SimulatedBed::at_checkpoint(changed, changed_plan, point.checkpoint, threads, true);
        for (const KeyDifference& one :
             deciding_differences(scene_to_keep(scene, plan), scene_to_keep(changed, changed_plan)))
            point.accepted.push_back({point.simulation.step(), one.key, one.then, one.now});
        scene = changed;
        plan = changed_plan;
        point.changed = true;
    }

    static Plan plan_to_go_on(const FilmedScene& scene, const fs::path& folder) {
        return with_film_warnings(scene, plan_of_run(scene, folder));
    }

    // The run's scene with the end that is asked for. If `undone` is empty, the values given with --accept
    // are set too; otherwise the values of `undone` are set in their place.
    FilmedScene scene_to_go_on(const fs::path& folder, const Assignments& undone) const {
        const fs::path file = scene_file(folder);
        Assignments sets;
        if (threads_) sets.push_back({fmt::format("run.threads={}", *threads_), "--threads"});
        for (const std::string& one : accept_)
            if (undone.empty() && one.find('=') != std::string::npos)
                for (Assignment& set : spelled_out(one, file)) sets.push_back(std::move(set));
        sets.insert(sets.end(), undone.begin(), undone.end());
        const FilmedScene before = read_filmed_scene(file, sets, measurable_in);
        const std::vector<KeptCheckpoint> kept = kept_checkpoints(folder);
        if (kept.empty())
            throw UserError(
                "{}: has no checkpoint; the run was stopped while its grains were packed, or its "
                "checkpoints were removed; run its scene.toml again",
                folder.string());
        const Plan plan = plan_of_run(before, folder);
        const double reached = plan.clock.time(reached_step(folder, kept.back().step));
        const double end = until_ ? *until_ : more_ ? reached + *more_ : before.run.duration;
        // A run that was killed while its film was being finished is not complete, though no step is left: it
        // may go on with the end that it has reached.
        const bool complete = read_run_json(folder / "run.json").record.status == RunStatus::complete;
        if (end < reached + (complete ? 0.5 : -0.5) * plan.clock.step)
            throw UserError("{}: the run has come to {:.6g} s already; give a later end, as in --for 5s",
                            until_ || more_ ? (until_ ? "--until" : "--for") : folder.string(), reached);
        if (until_ || more_)
            sets.push_back({fmt::format("run.duration={} s", end), until_ ? "--until" : "--for"});
        return read_filmed_scene(file, sets, measurable_in);
    }

    // Gives the scene its former name, since run.json and the pictures name the scene from which the run was
    // made.
    static void name_as_before(FilmedScene& scene, const fs::path& folder) {
        const std::string file = read_run_json(folder / "run.json").record.scene_file;
        if (file.empty()) return;
        scene.file = file;
        scene.name = fs::path(file).stem().string();
    }

    fs::path run_;
    std::optional<double> until_, more_;
    std::optional<int> threads_;
    std::vector<std::string> accept_;
    bool no_film_ = false, no_page_ = false;
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> resume_verb() {
    return std::make_unique<Resume>();
}

}  // namespace grainreel
