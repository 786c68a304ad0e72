// What a run writes on top of its trajectory and its measures, as plain values: fields, and files in formats
// of other programs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace grainreel {

// What a scene says about the fields that are kept in fields.nc, as plain values in SI units.
struct FieldOutput {
    // none: no fields; yz: means over the depth; xyz: in three dimensions.
    enum class Grid { none, yz, xyz };
    enum class Kernel { gaussian, lucy };
    Grid grid = Grid::none;
    Kernel kernel = Kernel::gaussian;
    double width = 0;  // m, the kernel's standard deviation along one axis
    double cell = 0;   // m, largest side of a cell
    int periods = 10;  // a record is a mean over so many periods of the drive; 0 without a drive
    int samples = 16;  // measurements in each period; without a drive, in each record
    std::optional<double>
        phase;            // turns; one measurement in each period, at this phase, in place of `samples`
    double interval = 0;  // s, length of a record without a drive; else 0

    bool wanted() const { return grid != Grid::none; }
    bool operator==(const FieldOutput&) const = default;
};

// Formats of other programs that a run can write beside its own files ([output] also). The writers are in
// engine/files/frames/writers, which the scene must not use; a test checks that both lists are the same.

inline constexpr std::array<std::string_view, 11> kAlsoFormats{
    "netcdf", "lammps-dump", "lammps-data", "xyz", "csv", "vtk", "vtkhdf", "stl", "gsd", "gltf", "blender"};

// A set of these formats, by their places in the list.
class AlsoFormats {
  public:
    bool any() const { return bits_ != 0; }
    bool has(std::size_t format) const { return (bits_ >> format & 1U) != 0; }
    void add(std::size_t format) { bits_ = static_cast<std::uint16_t>(bits_ | 1U << format); }
    bool operator==(const AlsoFormats&) const = default;

  private:
    std::uint16_t bits_ = 0;
    static_assert(kAlsoFormats.size() <= 16);
};

}  // namespace grainreel
