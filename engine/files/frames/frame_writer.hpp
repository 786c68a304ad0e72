// What writes frames in one format. A writer is a file in engine/files/frames/writers and a line in the list
// of write_frames.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"

namespace grainreel {

class FrameWriter {
  public:
    virtual ~FrameWriter() = default;

    // Called in this order: begin() once, frame() by rising time, end() once. `supply` says what each frame
    // will have beside its places. All throw RunError when it cannot be written; what is whole by then stays
    // readable.
    virtual void begin(const World& world, const FrameSupply& supply) = 0;
    virtual void frame(const Frame& frame) = 0;
    virtual void end() = 0;

    // For formats that have them. Before frame(): the contacts of that frame, where the record knows their
    // points and tangential forces. Before end(): those records of the fields that are means over a time with
    // one of the frames in it.
    virtual bool takes_all() const { return false; }
    virtual void contacts(const std::vector<ContactRecord>&) {}
    virtual void fields(const FieldsReader&, const std::vector<std::size_t>& /*records*/) {}
};

struct FrameFormat {
    const char* name;    // "trajectory"
    const char* about;   // "a trajectory.nc, as runs have it"
    const char* ending;  // of a file's or folder's usual name: ".xyz", "-vtk"
    // Nothing is written before begin().
    std::unique_ptr<FrameWriter> (*make)(const std::filesystem::path& path);
};

// Writes frames in any format that there is.

const std::vector<FrameFormat>& frame_formats();

// Throws UserError, with a list of the names, where there is no such format.
std::unique_ptr<FrameWriter> frame_writer(const std::string& format, const std::filesystem::path& path);

// Writes the frames of any record in any format: what a converter does.

struct ExportChoice {
    std::optional<double> from, until, at;  // s
    std::int64_t every = 1;                 // one of so many frames
};

struct Exported {
    std::filesystem::path path;  // file or folder
    std::int64_t frames = 0;
    std::uintmax_t bytes = 0;
};

// format: a name of frame_formats(). The result gets its name only when it is whole. Throws UserError where
// no frame is chosen, where `path` is there already (unless `replace`) or cannot be made, RunError where the
// disk is full. watcher: called with the share that is done; false stops, and nothing is left.
Exported export_frames(const FrameArchive& frames, const std::string& format,
                       const std::filesystem::path& path, const ExportChoice& choice, bool replace,
                       const std::function<bool(double)>& watcher);

// What writers of text share: a file that says when the disk is full, and the box around a frame.

// Text that is written in pieces of some MB.
class TextPieces {
  public:
    explicit TextPieces(const std::filesystem::path& path) : file_(path) {}

    std::string& text() { return text_; }
    // Writes where much has gathered.
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

// The world's cell along its periodic edges, and else what holds all grains of the frame, whole.
WorldCell box_of(const World& world, const Frame& frame);

// The name of a species without blanks, for formats that part words by them.
std::string one_word(const std::string& name);

}  // namespace grainreel
