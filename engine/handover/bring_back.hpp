// Turns the folder of a hand-over, whose engine has run or still runs, into the folder of a run of ours. The
// dump is read as far as it is written, and the container's motion is added where the run was in its frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct BroughtBack {
    std::int64_t frames = 0;
    double until = 0;               // s, time of the last frame
    bool whole = false;             // whether the run has come to its end
    std::vector<std::string> news;  // what the user should know of the run, a line each
};

// Writes trajectory.nc, measures.csv, final.csv and, for a scene with an outlet, outflow.csv beside the dump,
// unless a trajectory.nc is there that is as new as the dump. If another process does so, waits for it.
// watcher: called with the share that is done; if it returns false, nothing is changed. A run that lost
// grains or got unsound (ReturnedRun) is brought back up to its last good frame, with a line in `news`.
// Throws UserError where there is no dump or it is of another run, and RunError where no frame of it is sound
// or files cannot be written.
BroughtBack bring_back(const std::filesystem::path& folder, const std::string& version,
                       const std::function<bool(double)>& watcher);

// A folder in the folder of a hand-over, in which the files of a run are made while its dump is read. No
// other process uses it meanwhile, and it is removed at the end.
class ReturningFolder {
  public:
    // None while another process has the folder of that name. Throws RunError where it cannot be made.
    static std::unique_ptr<ReturningFolder> take(const std::filesystem::path& folder,
                                                 const std::string& name = ".returning");
    ~ReturningFolder();
    ReturningFolder(const ReturningFolder&) = delete;
    ReturningFolder& operator=(const ReturningFolder&) = delete;

    const std::filesystem::path& path() const { return lock_.folder(); }
    // Moves the run's files into the folder of the hand-over, in place of those that are there.
    void move_out() const;

  private:
    explicit ReturningFolder(FolderLock lock) : lock_(std::move(lock)) {}
    FolderLock lock_;
};

// Makes the files of a run of ours (trajectory.nc, measures.csv, outflow.csv, final.csv) from the dump of
// another engine, while it grows or at once.
class ReturnedRun {
  public:
    // folder: where the files are made. scene, plan: those that were handed over; they must outlive this
    // object. version: that of our program. Throws RunError where files cannot be written.
    ReturnedRun(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                const HandoverFacts& facts, const std::string& version);
    ~ReturnedRun();

    // Writes the next whole frame of the dump. Returns false where there is none so far. Throws UserError for
    // a dump that does not fit the deck, and RunError for grains that were lost and a state that is not sound
    // (ReturnedHealth). After that no further frame may be taken.
    bool take_next();
    // Whether the dump has become shorter than what was read of it, as when its job goes on from a restart
    // file.
    bool dump_is_shorter() const;
    // Reads the dump from its beginning again. Moments that were taken already are passed over.
    void read_anew();
    // Writes final.csv of the last frame, and what run.json says about the files.
    void close(RunJson& record);

    // A line about the contact that overlapped far more than planned; empty where none did.
    std::string overlap_text() const;
    std::int64_t frames() const;
    const State* last() const;                               // null before the first
    static constexpr const char* kFolder = kHandoverFolder;  // of deck and dump, in the run's folder

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
