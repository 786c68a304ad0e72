// What all runs share that fill a folder: the folder, its log, run.json, and an end that keeps what there is,
// whatever happened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/run/folder/listener.hpp"

namespace grainreel {

// What is asked of a run that fills a folder.

// Makes the page of the run in a folder, whose other files are closed, and returns its file's name. go_on:
// told the share that is done; when it says false the page is left out, and nothing is returned. Throws when
// the page cannot be made.
using PageMaker = std::function<std::optional<std::string>(const std::filesystem::path& folder,
                                                           const std::function<bool(double)>& go_on)>;

struct RunRequest {
    std::optional<std::filesystem::path> out;  // new or empty; none: base and the scene's name, numbered
    std::filesystem::path base = "output";     // of runs without `out`
    bool force = false;                        // a run in `out` is replaced
    // s: packings that took so long or longer are kept in the user's cache folder, and found there; none: no
    std::optional<double> keep_packings;
    PageMaker page;       // none: the run leaves no page
    std::string command;  // as typed, for run.json
    ProgramInfo program;  // for run.json
};

// Something else that is made in a run's folder, on threads of its own: a film.
class SideWork {
  public:
    virtual ~SideWork() = default;
    // Whether it has begun, and is neither closed nor dropped.
    virtual bool is_open() const = 0;
    // For the sentence "stopping: finishing the film".
    virtual const char* name() const = 0;
    // Finishes it; in a hurry, or when the folder is gone, leaves it as it is. Notes a failure and throws
    // nothing. Nothing happens where it is not open.
    virtual void close() = 0;
    // Called when the run is put back as it was; nothing else is called afterwards.
    virtual void drop() = 0;
    // What run.json says of it: before it is begun, while it is open, and when it is closed.
    virtual void describe(RunJson& record) const = 0;
};

class FolderRun {
  public:
    virtual ~FolderRun();
    FolderRun(const FolderRun&) = delete;
    FolderRun& operator=(const FolderRun&) = delete;

    struct Ended {
        // 0, 1 when it failed on its way (what it had is kept), 129, 130 or 143 when it was asked to stop.
        int exit_status = 0;
        std::optional<std::filesystem::path> folder;  // none once somebody has removed or replaced it
    };
    // Once. Throws UserError before anything is worth keeping; nothing is on disk then.
    Ended run();
    const std::filesystem::path& folder() const { return desk_.folder->path(); }
    const FirstFailure& failure() const { return desk_.failure; }

  protected:
    FolderRun(RunRequest request, RunListener& listener);

    // The work itself, between the made folder and what is kept at the end; false when asked to stop.
    virtual bool work() = 0;
    // What is made beside the run; null for nothing.
    virtual SideWork* side_work() { return nullptr; }
    // After the work, whatever happened, and before side work is finished, which may take its time: what else
    // is to be kept.
    virtual void keep_state() {}
    // What the record says of that. By then the record has its status. May be called twice.
    virtual void conclude() {}
    // All side work is closed, and the folder is there.
    virtual void side_work_closed() {}
    // Whether the run goes on in its folder and has not come to where it was, so that the folder is to be put
    // back as it was; and that it is, by a run that calls nothing else afterwards.
    virtual bool is_behind_former() const { return false; }
    virtual void put_back() {}
    virtual std::string stopped_text() const = 0;  // "stopped at 0.10 of 0.20 s"
    virtual void report_written() = 0;             // that which went well

    // To be called when all that the user gave has been accepted. of: name, and the lock of a run that goes
    // on; the rest follows from what was asked for.
    void make_folder(RunFolderRequest of);
    // From here a mistake is a failure, and what there is stays, also at a second signal.
    void mark_begun();
    // Shows the warnings and writes run.json for the first time.
    void begin_record(const std::vector<std::string>& warnings);
    // Shows how far the export to a format is, and says whether it may go on. For write_also().
    bool tell_export(const std::string& format, double done);
    std::string page_text() const;  // ", report.html"; empty without a page

    const RunRequest request_;
    RunDesk desk_;

  private:
    void note_folder();
    void find_folder();
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
    bool has_folder_ = true;  // false once somebody has removed or replaced it
};

}  // namespace grainreel
