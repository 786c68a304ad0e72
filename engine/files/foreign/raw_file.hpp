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

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// What a file of another program holds at one moment, under the file's own names and in its own units. What
// the names mean, and what they are in SI, is decided elsewhere (meaning.hpp), once for all formats.

// One number a row. A vector has a column for each component: "v:0", "v:1", "v:2". Places are "x", "y", "z"
// where the format has a place of its own for them (VTK's Points, XYZ, GSD). Numbers that are missing are
// NaN.
struct RawColumn {
    std::string name;
    std::vector<double> values;
    // Words in place of numbers (element names of XYZ, types of GSD): each value is an index into this list.
    std::vector<std::string> words{};
};

struct RawTable {
    std::size_t rows = 0;
    std::vector<RawColumn> columns;  // of `rows` values each

    // By its exact name; null where there is none. Of doubled names the first.
    const RawColumn* find(const std::string& name) const;
};

// A surface of walls, in the file's unit of length, where it is at that moment.
struct RawWall {
    std::string name;   // "bucket"; empty where the file has none
    TriangleMesh mesh;  // quads and strips are split into triangles
    RawTable cells{};   // a row a triangle: stress, wear
};

struct RawFrame {
    std::optional<std::int64_t> step;
    std::optional<double> time;    // in the file's unit of time
    std::optional<WorldCell> box;  // in the file's unit of length; tilted boxes have tilted edges
    RawTable grains;               // a row a grain, in the file's order
    RawTable contacts;             // a row a contact
    std::vector<RawWall> walls;
};

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
