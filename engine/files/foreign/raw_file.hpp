// A file of another program and its frames, under the file's own names and in its own units. Their meaning
// and SI are found once for all formats, in grain_columns.hpp. A new format is a function that returns a
// RawFormat, and a line in the list of raw_file.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// A column with one number in each row. A vector has a column for each component: "v:0", "v:1", "v:2". Places
// are "x", "y", "z" where the format keeps them apart from other columns (VTK's Points, XYZ, GSD). A missing
// number is NaN.
struct RawColumn {
    std::string name;
    std::vector<double> values;
    // For a column of words (elements in XYZ, types in GSD) each value is an index into this list.
    std::vector<std::string> words{};
};

struct RawTable {
    std::size_t rows = 0;
    std::vector<RawColumn> columns;  // with `rows` values each

    // The first column with exactly this name; null where there is none.
    const RawColumn* find(const std::string& name) const;
};

// The rows of a table by rising id.
template <typename Id>
std::vector<std::size_t> rows_by_id(const std::vector<Id>& ids) {
    std::vector<std::size_t> rows(ids.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    if (!std::is_sorted(ids.begin(), ids.end()))
        std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    return rows;
}

// A surface of walls in its place at that moment, in the file's unit of length.
struct RawWall {
    std::string name;   // "bucket"; empty where the file has none
    TriangleMesh mesh;  // quads and strips are split into triangles
    RawTable cells{};   // stress, wear: a row for each triangle
};

// What a file holds at one moment.
struct RawFrame {
    std::optional<std::int64_t> step;
    std::optional<double> time;    // in the file's unit of time
    std::optional<WorldCell> box;  // in the file's unit of length; tilted boxes have tilted edges
    RawTable grains;               // a row for each grain, in the order of the file
    RawTable contacts;             // a row for each contact
    std::vector<RawWall> walls;
};

// A moment without its tables.
struct RawMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};  // in the file's unit of time
    std::int64_t grains = 0;
    bool has_contacts = false, has_walls = false;
    bool open = false;  // more of it may come: no line ends behind its last row

    bool operator==(const RawMoment&) const = default;
};

// Facts that hold for the whole file.
struct RawFacts {
    std::string format;             // "LAMMPS text dump"
    std::string program;            // the program that wrote it, with its version, if the file says so
    std::string units;              // "si", "lj", "cgs", "micro", "real", ...; empty if the file does not say
    std::optional<Vec3> gravity{};  // in the file's units, if it says
    // m in the unit of length and s in the unit of time, where the format fixes them.
    std::optional<double> length_unit{}, time_unit{};
    int dimensions = 3;    // 2 if the file says so
    int first_row_id = 1;  // id of a frame's first row in a file without ids, used by contacts
};

// The file has no whole frame, but may get one.
class NotYetWhole : public UserError {
  public:
    using UserError::UserError;
};

class RawFile {
  public:
    explicit RawFile(std::filesystem::path file) : file_(std::move(file)) {}
    virtual ~RawFile() = default;

    const RawFacts& facts() const { return facts_; }
    // All whole frames, in the order of the file. A frame that is cut at the end is left out, with a line of
    // news(). If no frame is whole, opening the file throws UserError (a dump: NotYetWhole).
    const std::vector<RawMoment>& moments() const { return moments_; }
    // Reads a frame. Throws UserError "FILE:LINE: what is wrong; what to do" (a byte in place of the line for
    // binary files). Counts are checked against the file's size before memory is asked for.
    virtual RawFrame read(std::size_t index) const = 0;
    // What the user should know about the file. Each line begins with the file's name.
    virtual std::vector<std::string> news() const { return news_; }
    // Looks for frames that were written since then. Returns whether moments() has more. Throws UserError if
    // the file was truncated or replaced.
    virtual bool grow() { return false; }
    // Whether grow() does so. Files of other formats are opened anew.
    virtual bool grows() const { return false; }

  protected:
    std::filesystem::path file_;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
    std::vector<std::string> news_;
};

struct RawFormat {
    const char* name;   // "lammps-dump"
    const char* about;  // "dumps of LAMMPS and LIGGGHTS (text)", for the list of what can be read
    // Whether this format reads the file. The content decides, not the name. head.bytes are unpacked.
    bool (*takes)(const FileStart& head);
    std::unique_ptr<RawFile> (*open)(const std::filesystem::path& file);
};

// All formats, in the order in which they are asked.
const std::vector<RawFormat>& raw_formats();

// The first format that reads the file; null where none does. Throws UserError where the file cannot be
// opened.
const RawFormat* raw_format_of(const std::filesystem::path& file);

}  // namespace grainreel
