// What writes frames in one format. A writer is a file in engine/files/frames/writers and a line in the list
// of write_frames.cpp.
#pragma once

#include <filesystem>
#include <memory>

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

}  // namespace grainreel
