#include "render/run/compare/compare_panel.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/cli/report/record.hpp"

namespace grainreel {

// Progress is noted on the thread that runs the scene and read on another.
SceneRun::GoOn LivePanel::noting(const SceneRun::GoOn& go_on) {
    return [this, go_on] {
        done_ = run_.done();
        speed_ = run_.recent_speed();
        return go_on();
    };
}

void LivePanel::begin(const std::filesystem::path& folder, const std::string& command) {
    const std::filesystem::path own = folder / place();
    std::error_code error;
    std::filesystem::create_directory(own, error);
    if (error) throw RunError(fmt::format("{}: cannot be made: {}", own.string(), error.message()));
    std::optional<FolderLock> lock = FolderLock::take(own, command);
    if (!lock) throw RunError(fmt::format("{}: another process has it", own.string()));
    run_.use_folder(folder_.emplace(std::move(*lock)));
    describe_program(record_, command);
    run_.describe(record_);
    record_.warnings = run_.plan().warnings;
    write_run_json(folder_->folder() / "run.json", record_);
}

bool LivePanel::pack(const SceneRun::GoOn& go_on) {
    const bool packed = run_.pack([&](const PackingProgress& now) {
        done_ = (now.stage == PackingProgress::Stage::growing ? 0.0 : 0.5) + 0.5 * now.done;
        return go_on();
    });
    done_ = 1;
    return packed && go_on();
}

std::vector<Frame> LivePanel::moments(const std::vector<Instant>& instants,
                                      const std::vector<FilmSegment>& segments) const {
    const Clock& clock = run_.plan().clock;
    std::vector<Frame> moments;
    for (const Shot& shot : shots_at(instants, segments, clock, run_.plan().steps)) {
        Frame moment;
        moment.step = shot.step;
        moment.time = clock.time(shot.step);
        moment.cycles = clock.cycles(shot.step);
        moment.phase = clock.phase(shot.step);
        moments.push_back(std::move(moment));
    }
    return moments;
}

void LivePanel::start(const std::vector<Instant>& instants, const std::vector<FilmSegment>& segments) {
    done_ = 0;
    run_.start(shots_at(instants, segments, run_.plan().clock, run_.plan().steps), segments, false);
}

FramePtr LivePanel::next(const SceneRun::GoOn& go_on) {
    if (again_ > 0) {
        --again_;
        return frame_;
    }
    const std::optional<SceneRun::Taken> taken = run_.next(noting(go_on));
    if (!taken) return nullptr;
    again_ = taken->segments.size() - 1;
    return frame_ = taken->frame;
}

bool LivePanel::finish(const SceneRun::GoOn& go_on) {
    run_.next(noting(go_on));
    return go_on();
}

void LivePanel::keep_state() {
    if (folder_ && folder_->follow()) run_.close(failed_);
}

void LivePanel::close(RunStatus status, int exit_status, FirstFailure& failure) {
    if (!folder_ || !folder_->is_there()) return;
    run_.conclude(record_);
    for (std::string& line : run_.news()) record_.warnings.push_back(std::move(line));
    record_.status = failed_.any()                 ? RunStatus::failed
                     : status == RunStatus::failed ? RunStatus::interrupted
                                                   : status;
    record_.exit_status = failed_.any() ? 1 : exit_status;
    record_.error = failed_.what();
    record_.finished = utc_now();
    record_.wall_seconds = run_.times().all();
    failed_.attempt([&] { write_run_json(folder_->folder() / "run.json", record_); });
    if (failed_.any()) failure.note(failed_.what());
}

std::vector<Frame> RecordedPanel::moments(const std::vector<Instant>& instants,
                                          const std::vector<FilmSegment>&) const {
    std::vector<Frame> moments;
    for (const Instant& instant : instants) moments.push_back(run_.moments()[run_.nearest(instant.time)]);
    return moments;
}

void RecordedPanel::start(const std::vector<Instant>& instants, const std::vector<FilmSegment>&) {
    for (const Instant& instant : instants) frames_.push_back(run_.nearest(instant.time));
}

FramePtr RecordedPanel::next(const SceneRun::GoOn& go_on) {
    if (!go_on()) return nullptr;
    done_ = static_cast<double>(next_ + 1) / static_cast<double>(frames_.size());
    return std::make_shared<const Frame>(run_.frame(frames_.at(next_++)));
}

}  // namespace grainreel
