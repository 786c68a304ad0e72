// Follows files that another program is still writing: each frame is filed once it is complete.
#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/run/import/import_run.hpp"
#include "render/film/run/followed.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

class FollowedFiles final : public Followed {
  public:
    FollowedFiles(const FollowRequest& what, const std::string& version, Listener& listener)
        : what_(what), listener_(listener) {
        request_.from = what.from;
        request_.reading = what.reading;
        request_.program_version = version;
        if (!what.reading.container.empty())
            throw UserError(
                "--container: its walls move with the drive, which --follow does not do; leave one out");
        for (const Assignment& set : what.sets)
            if (set.key().rfind("film.walls.colour", 0) == 0 && set.value() != "plain")
                throw UserError(
                    "{}: stress and wear of walls are known once all files are read; leave out --follow",
                    set.place());
    }

    const fs::path& folder() const override { return place_->folder(); }
    const FilmedScene& scene() const override { return scene_; }
    std::vector<std::string> news() const override { return import_->news(); }
    std::int64_t frames() const override { return import_->frames(); }

    void wait_for_first() override {
        open_files();
        import_->run();
        scene_ = scene_of_run(folder(), what_.sets);
    }

    void tell_begin() const override {
        listener_.info(fmt::format("{}: {} so far; the film ends {:.3g} s after the last one, or with Ctrl-C",
                                   what_.from.string(), counted(frames(), "frame"), what_.idle));
    }

    bool take_next() override {
        try {
            return unsound_.empty() && (import_->take_next() || (look() && import_->take_next()));
        } catch (const std::exception& wrong) {  // what was read so far is still drawn
            unsound_ = wrong.what();
            return false;
        }
    }

    bool is_over(bool idle) override {
        if (idle && !wrong_.empty() && unsound_.empty())
            unsound_ = fmt::format("{} (after {} of the film; it was truncated or replaced)", wrong_,
                                   counted(frames(), "frame"));
        if (idle) import_->end();
        over_ = over_ || idle || !unsound_.empty();
        return over_;
    }

    void finish() override {
        for (const std::string& line : import_->later_news()) listener_.warning(line);
        if (!unsound_.empty()) throw RunError(unsound_);
    }

  private:
    void open_files();
    bool look();

    const FollowRequest what_;
    Listener& listener_;
    ImportRequest request_;
    std::optional<UnfinishedImport> place_;
    std::unique_ptr<Import> import_;
    FilmedScene scene_;
    Stopwatch since_look_;
    double pause_ = 0;     // s between two looks
    bool over_ = false;    // nothing has come for too long
    std::string wrong_;    // what was wrong with the files at the last look; empty: nothing
    std::string unsound_;  // why no more frames may be taken
};

void FollowedFiles::open_files() {
    place_.emplace(request_);
    request_.folder = folder();
    fs::create_directories(folder());
    const Stopwatch waiting;
    std::string why = what_.from.string() + ": is not there, or holds no frame yet";
    while (!import_) {
        const bool last = waiting.seconds() >= what_.idle;
        try {
            if (is_foreign(what_.from)) import_ = std::make_unique<Import>(request_, last);
        } catch (const UserError& not_yet) {
            why = not_yet.what();  // may be no mistake but a header that is half written
        }
        if (!import_ && (last || listener_.stop_signal() != 0))
            throw UserError("{} (--follow waited {:.3g} s)", why, what_.idle);
        if (!import_) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
}

// Looks for frames that have come, unless it did so just now: looking at many files takes long, and the pause
// keeps it from taking all the time.
bool FollowedFiles::look() {
    if (over_ || since_look_.seconds() < pause_) return false;
    const Stopwatch looking;
    wrong_.clear();
    try {
        import_->grow();
    } catch (const UserError& why) {
        wrong_ = why.what();  // a file may be half written; the next look sees more
    }
    place_->touch();
    pause_ = std::clamp(5 * looking.seconds(), 0.25, 0.25 * what_.idle + 0.25);
    since_look_ = Stopwatch();
    return wrong_.empty();
}

}  // namespace

std::unique_ptr<Followed> follow_files(const FollowRequest& what, const std::string& version,
                                       Listener& listener) {
    return std::make_unique<FollowedFiles>(what, version, listener);
}

}  // namespace grainreel
