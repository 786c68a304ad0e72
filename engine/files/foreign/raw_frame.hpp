// What a file of another program holds at one moment, under the file's own names and in its own units. What
// the names mean, and what they are in SI, is decided elsewhere (meaning.hpp), once for all formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/world.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

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

}  // namespace grainreel
