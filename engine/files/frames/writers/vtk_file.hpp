// A .vtp file of VTK (PolyData): arrays in the appended section, raw, each packed by zlib in blocks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

struct VtkArray {
    std::string name;
    std::string type;  // "Float64", "Float32", "Int64", "Int32", "UInt8"
    int components = 1;
    std::string bytes;  // the numbers as they lie in memory, little endian

    static VtkArray doubles(std::string name, const std::vector<double>& values, int components = 1);
    static VtkArray floats(std::string name, const std::vector<double>& values, int components = 1);
    static VtkArray integers(std::string name, const std::vector<std::int64_t>& values);
};

// A piece of PolyData. Connectivity and offsets as VTK has them, for one of vertices, lines and triangles.
struct VtkPolyData {
    enum class Cells { vertices, lines, triangles };
    Cells cells = Cells::vertices;
    std::vector<double> points;  // x y z
    std::vector<std::int64_t> connectivity;
    std::int64_t points_a_cell = 1;
    std::vector<VtkArray> point_data, cell_data;
    std::optional<double> time;  // s, as TimeValue
};

// The file's text and bytes. Packs the blocks on several threads.
std::string vtk_bytes(const VtkPolyData& data);

// An unpacked file's name and time, for a .pvd.
struct VtkEntry {
    double time = 0;
    int part = 0;
    std::string file;
};
std::string pvd_text(const std::vector<VtkEntry>& entries);

}  // namespace grainreel
