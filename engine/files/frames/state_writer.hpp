// Frames written in any format: what a writer must do, the list of all formats, and export_frames(), which
// writes the frames of an archive. A new format is a class in engine/files/frames/writers and a line in the
// list of frame_writer.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

class StateWriter {
  public:
    virtual ~StateWriter() = default;

    // The caller calls begin() once, then frame() by rising time, then end() once. `supply` says what each
    // frame will have beside its places. touches: which bodies push each other; empty where that is not
    // known. All three throw RunError when the file cannot be written. Frames that are whole by then stay
    // readable.
    virtual void begin(const StoredWorld& world, const StateSupply& supply) = 0;
    virtual void frame(const State& frame, const std::vector<Link>& touches) = 0;
    virtual void end() = 0;

    // Whether the format also has contacts and fields, so that the next two functions are called.
    virtual bool takes_all() const { return false; }
    // Called before frame() with the contacts of that frame, where the archive knows their points and
    // tangential forces.
    virtual void contacts(const std::vector<SavedContact>&) {}
    // Called before frame() with the box of that frame, for formats that have one.
    virtual void cell(const std::optional<WorldCell>&) {}
    // What the user should know of the file, once it is written.
    virtual std::vector<std::string> news() const { return {}; }
    // Called before end(). Each of these records of fields.nc is a mean over a span of time in which a frame
    // lies.
    virtual void fields(const FieldsReader&, const std::vector<std::size_t>& /*records*/) {}
};

// For formats that a run starts from. These throw UserError where the velocity or spin of a grain is not
// known, and tell that grains are at rest where none is known.
void refuse_unknown_motion(const std::filesystem::path& path, const State& frame);
std::vector<std::string> news_of_rest(const std::filesystem::path& path, const StateSupply& supply);

struct WriteFormat {
    const char* name;    // "trajectory"
    const char* about;   // "a trajectory.nc, as runs have it"
    const char* ending;  // the usual end of the file's or folder's name: ".xyz", "-vtk"
    // Makes a writer. Nothing is written before begin().
    std::unique_ptr<StateWriter> (*make)(const std::filesystem::path& path);
};

// For WriteFormat::make: makes a writer of that class.
template <class Writer>
std::unique_ptr<StateWriter> make_writer(const std::filesystem::path& path) {
    return std::make_unique<Writer>(path);
}

// All formats, in the order in which help lists them.
const std::vector<WriteFormat>& frame_formats();

// A writer of the format with that name. Throws UserError with a list of the names where there is none.
std::unique_ptr<StateWriter> frame_writer(const std::string& format, const std::filesystem::path& path);

// Which frames of an archive are exported.
struct ExportChoice {
    std::optional<double> from{}, until{}, at{};  // s
    std::int64_t every = 1;                       // one of so many frames is taken
};

struct Exported {
    std::filesystem::path path;  // file or folder
    std::int64_t frames = 0;
    std::uintmax_t bytes = 0;
    double first = 0;      // s, time of the first frame
    bool is_asked = true;  // with ExportChoice::at: whether that frame is the moment that was asked for
    std::vector<std::string> news{};  // what the user should know, a line each
};

// Throws UserError where `path` exists already (unless `replace`), or the folder around it is missing.
void check_free(const std::filesystem::path& path, bool replace);

// Writes frames in the format of that name. The result gets its name only when it is whole. Throws UserError
// where no frame is chosen, where a time lies outside the run, and where `path` exists already (unless
// `replace`) or cannot be made; throws RunError where the disk is full. watcher: called with the share that
// is done. If it returns false, the export stops and leaves nothing.
Exported export_frames(const StateArchive& frames, const std::string& format,
                       const std::filesystem::path& path, const ExportChoice& choice, bool replace,
                       const std::function<bool(double)>& watcher);

// For writers of text: a text file that is written in pieces of some MB.
class TextPieces {
  public:
    explicit TextPieces(const std::filesystem::path& path) : file_(path) {}

    std::string& text() { return text_; }
    // Writes the text so far if much has gathered.
    void pass() {
        if (text_.size() > (std::size_t{1} << 22)) flush();
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

  private:
    TextFile file_;
    std::string text_;
};

// The box of a frame: along periodic edges the world's cell, along others just wide enough for all grains.
WorldCell box_of(const StoredWorld& world, const State& frame);

// The name of a species without blanks, for formats in which blanks separate words.
std::string one_word(const std::string& name);

}  // namespace grainreel
