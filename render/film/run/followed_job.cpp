// Follows the job of a scene that was handed over: each moment is filed once the dump has it whole. The film
// ends with the job.
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/run_json.hpp"
#include "engine/handover/bring_back.hpp"
#include "engine/handover/peer_process.hpp"
#include "render/film/run/followed.hpp"
#include "render/film/sources/film_needs.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Takes a free working folder. The folders are numbered, because several programs may follow one job.
std::unique_ptr<ReturningFolder> free_folder(const fs::path& folder) {
    for (int number = 1;; ++number)
        if (auto made = ReturningFolder::take(folder, fmt::format(".following-{}", number))) return made;
}

class FollowedJob final : public Followed {
  public:
    FollowedJob(const FollowRequest& what, const std::string& version, Listener& listener)
        : what_(what),
          version_(version),
          listener_(listener),
          facts_(read_handover(what.from)),
          scene_(scene_of_run(what.from, what.sets)),
          plan_(make_plan(scene_)),
          returning_(free_folder(what.from)) {
        if (const auto lack = lacking_elsewhere(scene_)) throw UserError("{}: {}", what.from.string(), *lack);
    }

    const fs::path& folder() const override { return returning_->path(); }
    const FilmedScene& scene() const override { return scene_; }
    const Plan* plan() const override { return &plan_; }
    std::int64_t frames() const override { return back_->frames(); }

    void wait_for_first() override;
    void tell_begin() const override;
    bool take_next() override;
    bool is_over(bool idle) override;
    void finish() override;

  private:
    // How the job is. A status that was there when the film began is of an earlier job, which may go on.
    JobEnd look_at_job();
    // Whether an error in reading came from a job that goes on and cuts the dump; then it is read anew.
    bool job_goes_on();
    bool read();
    bool is_whole() const { return back_->last()->step >= facts_.last; }

    const FollowRequest what_;
    const std::string version_;
    Listener& listener_;
    const HandoverFacts facts_;
    const FilmedScene scene_;
    const Plan plan_;
    std::unique_ptr<ReturningFolder> returning_;
    std::unique_ptr<ReturnedRun> back_;
    std::string job_;         // name of the job whose moments come
    bool earlier_ = false;    // whether the status is still that of the job before the film began
    bool ends_idle_ = false;  // the job goes on, but nothing has come for too long
    std::string unsound_;     // why no more moments may be taken
};

void FollowedJob::wait_for_first() {
    keep_mesh_files(scene_, folder());
    fs::copy_file(what_.from / "scene.toml", folder() / "scene.toml");
    back_ = std::make_unique<ReturnedRun>(folder(), scene_, plan_, facts_, version_);
    const JobEnd before = job_end(what_.from, facts_);
    job_ = before.job;
    const Stopwatch waiting;
    while (!read()) {
        const JobEnd job = look_at_job();
        if (job.ended && !read()) {
            if (!job.failure.empty())
                throw RunError("{}: has no whole moment; {}", facts_.dump.string(), job.failure);
            throw UserError("{}: has no whole moment, and the job has ended", facts_.dump.string());
        }
        if (job.ended) break;
        if (waiting.seconds() >= what_.idle || listener_.stop_signal() != 0)
            throw UserError(
                "{}: is not there, or has no whole moment yet (--follow waited {:.3g} s); has the "
                "job begun?",
                facts_.dump.string(), waiting.seconds());
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    // Without a moment there is nothing from which a job could go on.
    earlier_ = before.ended && before.job == job_;
}

void FollowedJob::tell_begin() const {
    if (earlier_ && !is_whole())
        listener_.info(
            fmt::format("{}: the job has ended before; if none goes on, the film ends after "
                        "{:.3g} s (--idle)",
                        what_.from.string(), what_.idle));
    listener_.info(
        fmt::format("{}: follows {} until {:.6g} s; the film ends with the job, when nothing "
                    "new has come for {:.3g} s, or with Ctrl-C",
                    facts_.dump.string(), name_of(facts_.engine), plan_.clock.time(facts_.last), what_.idle));
}

JobEnd FollowedJob::look_at_job() {
    JobEnd now = job_end(what_.from, facts_);
    if (!now.ended || now.job != job_) earlier_ = false;
    if (!now.job.empty() && now.job != job_) {
        job_ = now.job;
        if (back_->last() == nullptr || now.goes_on)
            back_->read_anew();
        else
            unsound_ = fmt::format(
                "{}: a new job began from the start, and its grains go other ways; begin "
                "--follow again",
                what_.from.string());
    }
    now.ended = now.ended && !earlier_;
    return now;
}

bool FollowedJob::job_goes_on() {
    const std::string before = job_;
    const JobEnd now = look_at_job();
    if (job_ != before) return true;
    // run.sh takes the status away before it cuts the dump.
    const bool cut = !now.begun && back_->dump_is_shorter();
    if (cut) back_->read_anew();
    return cut;
}

bool FollowedJob::read() {
    try {
        return back_->take_next();
    } catch (const std::exception&) {
        if (!job_goes_on()) throw;
        return false;
    }
}

bool FollowedJob::take_next() {
    try {
        return unsound_.empty() && read();
    } catch (const std::exception& wrong) {  // what was read so far is still drawn
        unsound_ = wrong.what();
        return false;
    }
}

bool FollowedJob::is_over(bool idle) {
    const JobEnd job = look_at_job();
    ends_idle_ = idle && !job.ended;
    return !unsound_.empty() || is_whole() || job.ended || idle;
}

// Leaves the run's files in the folder of the hand-over.
void FollowedJob::finish() {
    const bool whole = is_whole();
    const double until = back_->last()->time;
    RunJson of_run;
    back_->close(of_run);
    back_.reset();
    returning_->move_out();
    if (!unsound_.empty()) throw RunError(unsound_);
    if (whole) return;
    const JobEnd job = job_end(what_.from, facts_);
    const std::string far = came_so_far(what_.from, facts_, until, plan_.clock.time(facts_.last));
    if (!job.failure.empty()) throw RunError(far);
    listener_.warning(ends_idle_ ? fmt::format("nothing new has come for {:.3g} s; {}", what_.idle, far)
                                 : far);
}

}  // namespace

std::unique_ptr<Followed> follow_job(const FollowRequest& what, const std::string& version,
                                     Listener& listener) {
    return std::make_unique<FollowedJob>(what, version, listener);
}

}  // namespace grainreel
