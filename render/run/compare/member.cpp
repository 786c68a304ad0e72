#include "render/run/compare/member.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

Member::Member(const FilmedScene& scene, const Plan& plan, int threads) {
    auto run = std::make_unique<SceneRun>(scene, plan, threads);
    run_ = run.get();
    source_ = std::move(run);
}

std::string Member::place() const {
    return run_ ? scene().name : std::filesystem::absolute(archive()->folder()).string();
}

void Member::begin(const std::filesystem::path& folder, const std::string& command,
                   const ProgramInfo& program) {
    if (!run_) return;
    const std::filesystem::path own = folder / place();
    std::error_code error;
    std::filesystem::create_directory(own, error);
    if (error) throw RunError(fmt::format("{}: cannot be made: {}", own.string(), error.message()));
    std::optional<FolderLock> lock = FolderLock::take(own, command);
    if (!lock) throw RunError(fmt::format("{}: another process has it", own.string()));
    run_->use_folder(folder_.emplace(std::move(*lock)), program.version);
    static_cast<ProgramInfo&>(report_) = program;
    report_.command = command;
    report_.started = utc_now();
    run_->describe(report_);
    report_.warnings = run_->plan().warnings;
    write_run_json(folder_->folder() / "run.json", report_);
}

bool Member::pack(const GoOn& go_on) {
    if (!run_) return true;
    const bool packed = run_->pack([&](const PackingProgress& now) {
        done_ = (now.stage == PackingProgress::Stage::settling ? 0.5 : 0.0) + 0.5 * now.done;
        return go_on();
    });
    done_ = 1;
    return packed && go_on();
}

void Member::start(const Pictures& pictures) {
    done_ = 0;
    source_->start(pictures);
}

// Progress is noted on the thread that runs the scene and read on another.
FramePtr Member::next(const GoOn& go_on) {
    const auto noting = [&] {
        if (run_) {
            done_ = run_->done();
            speed_ = run_->recent_speed();
        }
        return go_on();
    };
    std::optional<Taken> picture = source_->next(noting);
    return picture ? std::move(picture->frame) : nullptr;
}

void Member::keep_state() {
    if (folder_ && folder_->follow()) run_->close(failed_);
}

void Member::close(RunStatus status, int exit_status, FirstFailure& failure) {
    if (!folder_ || !folder_->is_there()) return;
    run_->conclude(report_);
    report_.warnings = run_->plan().warnings;
    for (std::string& line : run_->news()) report_.warnings.push_back(std::move(line));
    report_.status = failed_.any()                 ? RunStatus::failed
                     : status == RunStatus::failed ? RunStatus::interrupted
                                                   : status;
    report_.exit_status = failed_.any() ? 1 : exit_status;
    report_.error = failed_.what();
    report_.finished = utc_now();
    report_.wall_seconds = run_->times().all();
    failed_.attempt([&] { write_run_json(folder_->folder() / "run.json", report_); });
    if (failed_.any()) failure.note(failed_.what());
}

}  // namespace grainreel
