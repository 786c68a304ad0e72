#include "engine/run/folder/folder_job.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <utility>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

constexpr int signal_base = 128;

std::int64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace

FolderJob::FolderJob(JobRequest request, Listener& listener) : request_(std::move(request)), desk_(listener) {
    static_cast<ProgramInfo&>(desk_.record) = request_.program;
    desk_.record.command = request_.command;
}

FolderJob::~FolderJob() = default;

void FolderJob::make_folder(FolderRequest of) {
    of.command = request_.command;
    desk_.folder.emplace(of);
    desk_.log.emplace(desk_.folder->path() / "log.txt", of.goes_on != nullptr);
    desk_.listener.keep_log(&*desk_.log);
}

FolderJob::Ended FolderJob::run() {
    bool stopped = false, mistaken = false;
    try {
        stopped = !work();
    } catch (const UserError& mistake) {
        if (!begun_) {
            desk_.listener.keep_log(nullptr);
            desk_.folder->discard();
            throw;
        }
        note_folder();
        mistaken = !desk_.failure.any();
        desk_.failure.note(mistake.what());
    } catch (const std::exception& problem) {
        note_folder();
        desk_.failure.note(words_of(problem));
    }
    if ((stopped || desk_.failure.any()) && is_behind_former()) return end_as_before(mistaken);
    if (stopped) {
        SideWork* const side = side_work();
        desk_.listener.info(side != nullptr && side->is_open()
                                ? fmt::format("stopping: finishing {}", side->name())
                                : "stopping: keeping what there is");
    }
    find_folder();
    keep_state();
    // A stopped run has this status in its record from here on, because a third signal may end it while side
    // work is finished.
    if (stopped) close_record(stopped);
    close_side_work();
    find_folder();
    if (has_folder_) desk_.failure.attempt([&] { side_work_closed(); });
    page_is_missing(request_.page && has_folder_ && !stopped && !desk_.failure.any());
    close_record(stopped);
    if (desk_.record.status == RunStatus::complete) desk_.folder->remove_previous();
    make_page();
    find_folder_again(stopped);
    report_end();
    return {*desk_.record.exit_status, has_folder_ ? std::optional(folder()) : std::nullopt};
}

// Ends a run that goes on and did not reach its former end.
FolderJob::Ended FolderJob::end_as_before(bool mistaken) {
    if (SideWork* const side = side_work()) side->drop();
    if (desk_.failure.any()) desk_.listener.error(desk_.failure.what());
    const std::string name = folder().string();
    try {
        desk_.folder->lock().check_there();
        put_back();
        desk_.listener.info(
            fmt::format("{}: is as it was before, since the run did not come past its former end", name));
    } catch (const RunError& problem) {
        desk_.listener.error(problem.what());
        desk_.listener.info(fmt::format("{}: the next `resume` puts back what the run was", name));
        desk_.failure.note(problem.what());
    }
    const int status = mistaken ? 2 : desk_.failure.any() ? 1 : signal_base + desk_.listener.stop_signal();
    return {status, mistaken ? std::nullopt : std::optional(folder())};
}

void FolderJob::mark_begun() {
    begun_ = true;
    desk_.listener.keep_before_exit();
}

// Notes a missing folder first, because it is then the cause of all other failures.
void FolderJob::note_folder() {
    desk_.failure.attempt([&] { desk_.folder->lock().check_there(); });
}

// Follows a folder that has been moved or removed. Side work is closed before the folder's name changes,
// because its threads use the old name.
void FolderJob::find_folder() {
    if (desk_.folder->lock().is_there()) return;
    note_folder();
    close_side_work();
    has_folder_ = desk_.folder->follow();
}

// A folder may vanish while the page is made, which takes longer than all else at the end.
void FolderJob::find_folder_again(bool stopped) {
    if (!has_folder_ || desk_.failure.any() || desk_.folder->lock().is_there()) return;
    find_folder();
    settle_status(stopped);
    desk_.record.error = desk_.failure.what();
    if (has_folder_) desk_.failure.attempt([&] { write_record(); });
}

void FolderJob::close_side_work() {
    if (SideWork* const side = side_work()) side->close();
}

void FolderJob::settle_status(bool stopped) {
    desk_.record.status = desk_.failure.any() ? RunStatus::failed
                          : stopped           ? RunStatus::interrupted
                                              : RunStatus::complete;
    desk_.record.exit_status = desk_.failure.any() ? 1
                               : stopped           ? signal_base + desk_.listener.stop_signal()
                                                   : 0;
}

void FolderJob::begin_record(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) desk_.listener.warning(warning);
    desk_.record.started = utc_now();
    if (const SideWork* const side = side_work()) side->describe(desk_.record);
    desk_.record.warnings = warnings;
    write_run_json(folder() / "run.json", desk_.record);
}

void FolderJob::close_record(bool stopped) {
    settle_status(stopped);
    conclude();
    settle_status(stopped);
    desk_.record.error = desk_.failure.what();
    desk_.record.finished = utc_now();
    if (const SideWork* const side = side_work()) side->describe(desk_.record);
    desk_.record.peak_memory = peak_memory();
    if (has_folder_) desk_.failure.attempt([&] { write_record(); });
    settle_status(stopped);
}

// The run counts as complete only with its page.
void FolderJob::write_record() {
    RunJson now = desk_.record;
    if (now.status == RunStatus::failed) now.missing.clear();
    if (!now.missing.empty() && now.status == RunStatus::complete) {
        now.status = RunStatus::running;
        now.exit_status.reset();
    }
    for (const auto& time : desk_.times.all()) now.wall_seconds.push_back(time);
    now.wall_seconds.emplace_back("total", desk_.watch.seconds());
    write_run_json(folder() / "run.json", now);
}

// Makes the page of a run whose other files are closed, also of a failed run. A missing page is not a failure
// of the run.
void FolderJob::make_page() {
    if (!request_.page || !has_folder_) return;
    if (desk_.listener.in_a_hurry()) return stop_before_page();
    if (!begun_ && !desk_.failure.any()) return;  // stopped before there was anything to show
    const Stopwatch making;
    const auto go_on = [&](double share) {
        Progress progress;
        progress.stage = Progress::Stage::paging;
        progress.done = share;
        progress.elapsed = desk_.watch.seconds();
        desk_.listener.progress(progress);
        return !desk_.listener.in_a_hurry() && desk_.folder->lock().is_there();
    };
    try {
        desk_.record.page = request_.page(folder(), go_on).value_or("");
        if (desk_.record.page.empty()) return stop_before_page();
        desk_.times.add("making the page", making.seconds());
        page_is_missing(false);
        write_record();
    } catch (const std::exception& problem) {
        desk_.listener.warning(fmt::format("the run has no page: {}", words_of(problem)));
        page_is_missing(false);
        desk_.failure.attempt([&] { write_record(); });
    }
}

void FolderJob::page_is_missing(bool missing) {
    desk_.record.missing.clear();
    if (missing) desk_.record.missing.emplace_back(kPageIsMissing);
}

// If the user is in a hurry, the page is left out. `resume` makes it later.
void FolderJob::stop_before_page() {
    if (desk_.record.missing.empty() || !desk_.folder->lock().is_there()) return;
    settle_status(true);
    desk_.failure.attempt([&] { write_record(); });
}

bool FolderJob::tell_export(const std::string& format, double done) {
    Progress progress;
    progress.stage = Progress::Stage::exporting;
    progress.what = format;
    progress.done = done;
    progress.elapsed = desk_.watch.seconds();
    desk_.listener.progress(progress);
    return !desk_.listener.in_a_hurry() && desk_.folder->lock().is_there();
}

std::string FolderJob::page_text() const {
    return desk_.record.page.empty() ? "" : ", " + desk_.record.page;
}

void FolderJob::report_end() {
    const std::string name = folder().string();
    if (desk_.failure.any()) {
        desk_.record.exit_status = 1;
        desk_.listener.error(desk_.failure.what());
        if (has_folder_) desk_.listener.info(fmt::format("what was made until then is in {}", name));
    } else if (desk_.record.status == RunStatus::interrupted) {
        desk_.listener.info(fmt::format("{}; what was made is in {}{}", stopped_text(), name,
                                        begun_ ? "" : " (still packing: no film)"));
    }
    if (begun_ && !desk_.failure.any()) report_written();
    if (!desk_.folder->previous().empty()) {
        desk_.listener.info(
            fmt::format("the run that was to be replaced is kept in {}", desk_.folder->previous().string()));
    }
}

}  // namespace grainreel
