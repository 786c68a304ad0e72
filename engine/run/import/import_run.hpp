// Turns frames of another program into the folder of a run: scene.toml, trajectory.nc, measures.csv, and
// contacts.nc where contacts are known. After that all commands that show or measure a run work with it.
//
// The copy costs as much disk space as the frames. In return no command needs code of its own for files of
// other programs, any moment is found at once, and damaged frames are found before the first picture.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/run/import/import_scene.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct ImportRequest {
    std::filesystem::path from;  // a file, a pattern or a folder
    ReadingOptions reading{};
    std::filesystem::path folder;  // the folder to make, which must not exist
    std::string program_version{};
    // Called with the share that is done. If it returns false, import_run() throws RunError and leaves
    // nothing.
    std::function<bool(double)> watcher{};
};

struct Imported {
    std::filesystem::path folder;
    std::int64_t frames = 0, most_grains = 0;
    std::vector<std::string> news;  // what was guessed, left out or derived, a line for each
};

// Throws UserError for what is wrong with the files, and RunError where the folder cannot be written. Nothing
// unfinished is left.
Imported import_run(const ImportRequest& request);

// An import frame by frame. What the files of a run depend on is known only after all frames: which types and
// sizes there are, and how many ids. So the files are begun for what the first frame says, and if this turns
// out to be wrong, they are made again for what all frames said. Thus frames are read once, or at most twice.
//
// The files of the other program may still grow: run(), then grow() and take_next() as often as one likes.
class Import {
  public:
    // Opens the files. at_end: the last frame counts even if more of it might come; else it waits. Throws
    // UserError where nothing there can be read yet. request: its folder must exist and be empty.
    Import(ImportRequest request, bool at_end);
    ~Import();
    Import(const Import&) = delete;
    Import& operator=(const Import&) = delete;

    // Makes the files of the frames that there are.
    Imported run();
    // Looks for frames that were written since. Throws UserError where a file may be half written, and
    // RunError where the frames or their walls are not those of before.
    void grow();
    // Says that nothing more will come: from now on the last frame counts.
    void end() { at_end_ = true; }
    // Adds the next frame to the files. False where there is none so far. Throws RunError for a new type.
    bool take_next();
    std::int64_t frames() const { return run_.frames; }
    const std::vector<std::string>& news() const { return run_.news; }
    // What frames that came after run() brought of it.
    std::vector<std::string> later_news() const;

  private:
    struct Files;
    ImportSurvey first_guess();
    std::size_t known() const;
    void begin(const ImportSurvey& guess, bool may_fail);
    void begin_again();
    void drop();
    ImportSurvey read_all(const ImportSurvey& guess);
    void take(std::size_t index, State frame);
    std::array<std::pair<std::int64_t, double>, 2> ends() const;
    void finish(const ImportSurvey& survey);
    void tell_of_contacts();
    void tell_of_box();

    const ImportRequest request_;
    ForeignArchive archive_;
    bool at_end_;
    const bool depends_on_box_;  // whether the header of trajectory.nc depends on the box around the grains
    std::unique_ptr<Files> files_;  // null while what was read does not fit the guess
    ImportSurvey survey_;           // of the frames that were taken
    std::size_t next_ = 0;          // number of the frame that take_next() takes
    std::array<std::pair<std::int64_t, double>, 2> ends_{};
    std::int64_t last_step_ = 0;
    std::optional<WorldCell> first_box_;
    bool box_changes_ = false;
    Imported run_;
};

// The same in the user's cache folder ($XDG_CACHE_HOME/grainreel/imports), where a later call with the same
// files (by name, size, times and inode, also those that a list names), options and program version finds it
// again. An import that was damaged or changed since is made anew. If all imports together exceed 4 GB, those
// are removed that were not used for the longest time. Without a cache folder that is the user's alone
// (own_folder.hpp), or where that is full, the import is made in the temporary folder. Throws UserError where
// a link or somebody else has taken the name there.
Imported cached_import(ImportRequest request);

// A message in which the folder of an import has the name of the files that it was made of, which the user
// knows: "bed.dump: trajectory.nc: frame 3 ...".
std::string named_as(std::string text, const std::filesystem::path& folder,
                     const std::filesystem::path& from);

// A folder for an import that no other process uses, beside those of cached_import(). It is removed at the
// end.
class UnfinishedImport {
  public:
    // Throws as cached_import() does.
    explicit UnfinishedImport(const ImportRequest& request);
    // Beside the folder in which the finished import will be. name: of the run.
    UnfinishedImport(const std::filesystem::path& place, const std::string& name);
    ~UnfinishedImport();
    UnfinishedImport(const UnfinishedImport&) = delete;
    UnfinishedImport& operator=(const UnfinishedImport&) = delete;

    // It is named after the files, and is not there yet.
    const std::filesystem::path& folder() const { return folder_; }
    // Says that it is still used. One that nobody used for a day is removed if there is no room.
    void touch() const;

  private:
    std::filesystem::path folder_;
};

// What is in that folder.
struct ImportsKept {
    std::filesystem::path folder;
    std::size_t imports = 0;
    std::uintmax_t bytes = 0, most_bytes = 0;  // size of all imports together, and its limit
    std::string fault{};  // why nothing is imported there, in words; empty if all is well
};
ImportsKept imports_kept();

}  // namespace grainreel
