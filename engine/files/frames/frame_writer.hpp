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
};

struct FrameFormat {
    const char* name;    // "trajectory"
    const char* about;   // "a trajectory.nc, as runs have it"
    const char* ending;  // of a file's or folder's usual name: ".xyz", "-vtk"
    // Nothing is written before begin().
    std::unique_ptr<FrameWriter> (*make)(const std::filesystem::path& path);
};

}  // namespace grainreel
