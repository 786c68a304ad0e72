#include "render/film/compare/member.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/run/driver/also_exports.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

ComparedMember::ComparedMember(const FilmedScene& scene, const Plan& plan, int threads)
    : driver_(std::make_unique<RunDriver>(scene, plan, threads)),
      source_(std::make_unique<SceneRun>(scene, *driver_)) {
    check_also(scene);
}

std::string ComparedMember::place() const {
    return driver_ ? scene().name : std::filesystem::absolute(archive()->path()).string();
}

void ComparedMember::begin(const std::filesystem::path& folder, const RunRequest& request) {
    if (!driver_) return;
    const std::filesystem::path own = folder / place();
    std::error_code error;
    std::filesystem::create_directory(own, error);
    if (error) throw RunError(fmt::format("{}: cannot be made: {}", own.string(), error.message()));
    std::optional<FolderLock> lock = FolderLock::take(own, request.command);
    if (!lock) throw RunError(fmt::format("{}: another process has it", own.string()));
    driver_->use_folder(folder_.emplace(std::move(*lock)), request.program.version);
    if (request.keep_packings) driver_->keep_packings(*request.keep_packings);
    static_cast<ProgramInfo&>(report_) = request.program;
    report_.command = request.command;
    report_.started = utc_now();
    driver_->describe(report_);
    report_.warnings = driver_->plan().warnings;
    write_run_json(folder_->folder() / "run.json", report_);
}

bool ComparedMember::pack(const GoOn& go_on) {
    if (!driver_) return true;
    const bool packed = driver_->pack([&](const PackingProgress& now) {
        done_ = (now.stage == PackingProgress::Stage::settling ? 0.5 : 0.0) + 0.5 * now.done;
        return go_on();
    });
    done_ = 1;
    return packed && go_on();
}

void ComparedMember::start(const Pictures& pictures) {
    done_ = 0;
    source_->start(pictures);
}

// Progress is noted on the thread that runs the scene and read on another.
FramePtr ComparedMember::next(const GoOn& go_on) {
    const auto noting = [&] {
        if (driver_) {
            done_ = driver_->done();
            speed_ = driver_->recent_speed();
        }
        return go_on();
    };
    std::optional<Taken> picture = source_->next(noting);
    return picture ? std::move(picture->frame) : nullptr;
}

void ComparedMember::keep_state() {
    if (folder_ && folder_->follow()) driver_->close(failed_);
}

void ComparedMember::write_other_formats(const std::function<bool(const std::string&, double)>& watcher) {
    if (!folder_ || !folder_->is_there() || !driver_->has_other_formats()) return;
    failed_.attempt([&] { write_also(folder_->folder(), driver_->scene(), watcher); });
}

void ComparedMember::close(RunStatus status, int exit_status, FirstFailure& failure) {
    if (!folder_ || !folder_->is_there()) return;
    driver_->conclude(report_);
    report_.warnings = driver_->plan().warnings;
    for (std::string& line : source_->news()) report_.warnings.push_back(std::move(line));
    report_.status = failed_.any()                 ? RunStatus::failed
                     : status == RunStatus::failed ? RunStatus::interrupted
                                                   : status;
    report_.exit_status = failed_.any() ? 1 : exit_status;
    report_.error = failed_.what();
    report_.finished = utc_now();
    report_.wall_seconds = driver_->times().all();
    failed_.attempt([&] { write_run_json(folder_->folder() / "run.json", report_); });
    if (failed_.any()) failure.note(failed_.what());
}

}  // namespace grainreel
