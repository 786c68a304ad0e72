// Base of all runs that fill a folder: the folder, its log, run.json, and an end that keeps all results,
// whatever happened.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/run/folder/listener.hpp"

namespace grainreel {

// Makes the page of a run (report.html) in its folder, when all other files are closed, and returns the name
// of the page's file. It calls go_on() with the share that is done. If that returns false, the page is left
// out, and nothing is returned. Throws if the page cannot be made.
using PageMaker = std::function<std::optional<std::string>(const std::filesystem::path& folder,
                                                           const std::function<bool(double)>& go_on)>;

// What the caller wants of a run that fills a folder.
struct JobRequest {
    std::optional<std::filesystem::path>
        out;                                // new or empty; if not set, base and the scene's name, numbered
    std::filesystem::path base = "output";  // folder for runs without `out`
    bool force = false;                     // whether a run in `out` is replaced
    // Time in s. Packings that took at least so long are kept in the user's cache folder, and later runs find
    // them there. Without a value nothing is kept or looked for.
    std::optional<double> keep_packings;
    PageMaker page;       // if empty, the run leaves no page
    std::string command;  // as typed, for run.json
    ProgramInfo program;  // for run.json
};

// Work in a run's folder on threads of its own, for example a film.
class SideWork {
  public:
    virtual ~SideWork() = default;
    // Whether it has begun, and is neither closed nor dropped.
    virtual bool is_open() const = 0;
    // For the sentence "stopping: finishing the film".
    virtual const char* name() const = 0;
    // Finishes the work. In a hurry, or if the folder is gone, it is left as it is. Notes a failure and
    // throws nothing. Does nothing if the work is not open.
    virtual void close() = 0;
    // Called when the run is put back to its former state. Nothing else is called afterwards.
    virtual void drop() = 0;
    // Adds the work to run.json: before it is begun, while it is open, and when it is closed.
    virtual void describe(RunJson& record) const = 0;
};

class FolderJob {
  public:
    virtual ~FolderJob();
    FolderJob(const FolderJob&) = delete;
    FolderJob& operator=(const FolderJob&) = delete;

    struct Ended {
        // 0; 1 if the run failed on its way (its results are kept); 2 if a mistake of the user stopped a
        // resumed run before its former end; 129, 130 or 143 if the run was asked to stop.
        int exit_status = 0;
        std::optional<std::filesystem::path> folder;  // empty once it has been removed or replaced, and with
                                                      // status 2
    };
    // Runs; call it once. Throws UserError before there are results; nothing is on disk then.
    Ended run();
    const std::filesystem::path& folder() const { return desk_.folder->path(); }
    const FirstFailure& failure() const { return desk_.failure; }

  protected:
    FolderJob(JobRequest request, Listener& listener);

    // Does the work of the run. The folder is there, and the end state is kept afterwards. Returns false if
    // it was asked to stop.
    virtual bool work() = 0;
    // The side work of the run, or null.
    virtual SideWork* side_work() { return nullptr; }
    // Keeps the end state. Called after the work, whatever happened, and before side work is finished, which
    // may take long.
    virtual void keep_state() {}
    // Adds the results to the record, which has its status by then. May be called twice.
    virtual void conclude() {}
    // Called when all side work is closed, if the folder is there.
    virtual void side_work_closed() {}
    // is_behind_former() says whether the run goes on in its folder and has not reached its former end. The
    // folder is then put back to its former state by put_back(), and nothing else is called afterwards.
    virtual bool is_behind_former() const { return false; }
    virtual void put_back() {}
    virtual std::string stopped_text() const = 0;  // "stopped at 0.10 of 0.20 s"
    virtual void report_written() = 0;             // reports what was written

    // Makes the folder. Call it when all input of the user has been accepted. `of` holds the name, the place
    // and, for a run that goes on, the lock. The command is added from the request.
    void make_folder(FolderRequest of);
    // From here on a mistake is a failure, and results are kept, also at a second signal.
    void mark_begun();
    // Shows the warnings and writes run.json for the first time.
    void begin_record(const std::vector<std::string>& warnings);
    // Shows the progress of the export to a format, and returns whether it may go on. This is for
    // write_also().
    bool tell_export(const std::string& format, double done);
    std::string page_text() const;  // ", report.html"; empty without a page

    const JobRequest request_;
    JobDesk desk_;

  private:
    void note_folder();
    void find_folder();
    void find_folder_again(bool stopped);
    void close_side_work();
    Ended end_as_before(bool mistaken);
    void settle_status(bool stopped);
    void close_record(bool stopped);
    void write_record();
    void make_page();
    void page_is_missing(bool missing);
    void stop_before_page();
    void report_end();

    bool begun_ = false;
    bool has_folder_ = true;  // false once it has been removed or replaced
};

}  // namespace grainreel
