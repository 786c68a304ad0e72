// One file of another program. A format is a function that gives its RawFormat, and a line in the list of
// raw_formats.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_frame.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// A moment without its numbers.
struct RawMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};  // in the file's unit of time
    std::int64_t grains = 0;
    bool has_contacts = false, has_walls = false;
};

struct RawFacts {
    std::string format;   // "LAMMPS text dump"
    std::string program;  // that wrote it, with its version, where the file says so
    std::string units;    // "si", "lj", "cgs", "micro", "real", ... as the file says; empty where it does not
    std::optional<Vec3> gravity{};  // in the file's units, where it says it
    // Where the format fixes them: m in one unit of length, s in one unit of time.
    std::optional<double> length_unit{}, time_unit{};
    int dimensions = 3;    // 2 where the file says so
    int first_row_id = 1;  // id of a frame's first row where the file has no ids; contacts count from there
    bool scaled_places = false;  // columns x, y, z are shares of the box (old dumps without names)
};

class RawFile {
  public:
    virtual ~RawFile() = default;

    virtual const RawFacts& facts() const = 0;
    // All that are whole, in the order of the file. A frame that is cut at the end is left out, with a line
    // of news(). Where no frame is whole, opening throws UserError.
    virtual const std::vector<RawMoment>& moments() const = 0;
    // Throws UserError "FILE:LINE: what is wrong; what to do" (byte in place of line in binary files). Counts
    // are bounded by the file's size before memory is asked for.
    virtual RawFrame read(std::size_t index) const = 0;
    // What the user is to know of the file, a line each, beginning with the file's name.
    virtual std::vector<std::string> news() const { return {}; }
    // Looks for frames that were written since. Returns whether moments() has more. A file that was truncated
    // or replaced throws UserError.
    virtual bool grow() { return false; }
};

struct RawFormat {
    const char* name;   // "lammps-dump"
    const char* about;  // "dumps of LAMMPS and LIGGGHTS (text)", for the list of what can be read
    // By content: the name of a file says nothing. head.bytes are those behind gzip and zstd.
    bool (*takes)(const FileHead& head);
    std::unique_ptr<RawFile> (*open)(const std::filesystem::path& file);
};

// All formats, in the order in which they are asked.
const std::vector<RawFormat>& raw_formats();

// The first that takes the file; null where none does. Throws UserError where the file cannot be opened.
const RawFormat* raw_format_of(const std::filesystem::path& file);

}  // namespace grainreel
