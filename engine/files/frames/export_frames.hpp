// Writes the frames of any record in any format: what a converter does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

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

}  // namespace grainreel
