// Opens whatever has frames.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// All readers, in the order in which they are asked.
const std::vector<FrameReader>& frame_readers();

// The one that takes what lies there; null where none does. Throws UserError where nothing lies there, or no
// ordinary file.
const FrameReader* reader_of(const std::filesystem::path& path);

// By the first reader that takes it, and with a frame at least; or by the one that is asked for. Throws
// UserError where there is none, with a list of what can be read, and for what its reader finds wrong.
std::unique_ptr<FrameArchive> open_frames(const std::filesystem::path& path,
                                          const FrameRequest& request = {});

// Readers that a program gives which uses the engine as a library. open_frames() asks them before its own.

class OwnReader {
  public:
    virtual ~OwnReader() = default;
    virtual std::string name() const = 0;
    virtual std::string about() const = 0;
    virtual bool takes(const FileHead& head) const = 0;
    virtual std::unique_ptr<FrameArchive> open(const std::filesystem::path& path,
                                               const FrameRequest& request) const = 0;
};

// In place of one that has its name. May be called from any thread.
void add_own_reader(std::shared_ptr<const OwnReader> reader);
// The last one first.
std::vector<std::shared_ptr<const OwnReader>> own_readers();

}  // namespace grainreel
