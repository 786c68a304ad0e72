// Readers that a program gives which uses the engine as a library. open_frames() asks them before its own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

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
