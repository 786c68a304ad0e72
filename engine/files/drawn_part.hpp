// What run.json says of a film that is one of several parts, so that they can be joined.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace grainreel {

struct DrawnPart {
    int number = 1, of = 1;
    std::int64_t first_picture = 0, pictures = 0, all_pictures = 0;
    std::int64_t first_frame = 0, frames = 0, all_frames = 0;  // with those that stand still for a caption
    double rate = 0;                                           // frames a second
    std::string file, format;                                  // its film: a file's name; empty without one
    // Checksums, 16 hexadecimal digits each: of the run and of what decides its pictures, by which parts of
    // one film know each other; and of the film's file, empty until that is complete.
    std::string run, settings, checksum;
};

// A part, as its run.json has it.
struct PartRecord : DrawnPart {
    std::string status;   // as RunStatus in words
    std::string program;  // "grainreel 0.9 (3f2a...)"
    std::string encoder, gl;
};

// None when the file is not there, is no run.json, or is not of a part. What it says of the part is
// consistent in itself: of counts none is negative, and the part lies in the whole.
std::optional<PartRecord> part_in_run_json(const std::filesystem::path& path);

// XXH64 of a file's bytes. Throws RunError when it cannot be read.
std::string checksum_of_file(const std::filesystem::path& path);

}  // namespace grainreel
