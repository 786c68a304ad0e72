// What reads one format of frames. A reader is a file in engine/files/frames/readers and a line in the list
// of open_frames.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/reading_options.hpp"

namespace grainreel {

// What lies under a name, and how it begins.
struct FileHead {
    std::filesystem::path path;
    bool folder = false;
    std::uintmax_t size = 0;  // bytes
    std::string bytes;        // the first kHeadBytes of them
};
inline constexpr std::size_t kHeadBytes = 65536;

struct FrameRequest {
    // The name of the reader, for who knows what a file must be; empty: its content decides.
    std::string format{};
    // Reads the scene.toml of a run's folder; none: as the engine reads it.
    std::function<Scene(const std::filesystem::path& folder)> scene_of_run{};
    // What the user says of files of other programs.
    ReadingOptions reading{};
};

struct FrameReader {
    const char* name;   // "trajectory"
    const char* about;  // "a trajectory.nc of a run", for the list of what can be read
    // By content: the name of a file says nothing.
    bool (*takes)(const FileHead& head);
    // Throws UserError when it cannot be read.
    std::unique_ptr<FrameArchive> (*open)(const std::filesystem::path& path, const FrameRequest& request);
};

}  // namespace grainreel
