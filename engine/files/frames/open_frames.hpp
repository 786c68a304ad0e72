// open_frames() opens any file or folder that holds frames. The list of readers is in open_frames.cpp; a
// program that uses the engine as a library can add readers of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"

namespace grainreel {

// All readers, in the order in which they are asked.
const std::vector<ReadFormat>& frame_readers();

// The first reader that reads what lies under the path; null where none does. Throws UserError where there is
// nothing, or something that is neither a file nor a folder.
const ReadFormat* reader_of(const std::filesystem::path& path);

// Opens an archive with the first reader that reads it, or with the one that `request` names. It then has at
// least one frame. Throws UserError for what the reader finds wrong and, with a list of what can be read,
// where no reader reads it.
std::unique_ptr<StateArchive> open_frames(const std::filesystem::path& path, const OpenRequest& request = {});

// A reader of a program that uses the engine as a library. open_frames() asks these readers first.
class OwnReader {
  public:
    virtual ~OwnReader() = default;
    virtual std::string name() const = 0;
    virtual std::string about() const = 0;
    virtual bool takes(const FileStart& head) const = 0;
    virtual std::unique_ptr<StateArchive> open(const std::filesystem::path& path,
                                               const OpenRequest& request) const = 0;
};

// Adds a reader, in place of one with the same name. May be called from any thread.
void add_own_reader(std::shared_ptr<const OwnReader> reader);
// All readers that were added; the last one comes first.
std::vector<std::shared_ptr<const OwnReader>> own_readers();

}  // namespace grainreel
