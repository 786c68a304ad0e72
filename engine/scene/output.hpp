// What a run can write, as plain values: columns of measures.csv, fields, and files in formats of other
// programs.
//
// The observers decide which columns there are (engine/measure/observer_list.hpp). The reader of a scene gets
// the list, because plots and live words (numbers shown in a film) name columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

struct Scene;

struct MeasureColumn {
    std::string name;   // "kinetic_J": the unit, when there is one, comes last
    std::string label;  // "kinetic energy"
    Dimension dimension = Dimension::number;
    std::string instrument = {};  // entry of output.instruments that the column needs; empty: none
    bool operator==(const MeasureColumn&) const = default;
};

// Columns that share a line of the documentation.
struct ColumnGroup {
    std::vector<MeasureColumn> columns;
    const char* unit;   // as in the documentation: "J", "turns, 0 to 1"
    const char* about;  // Markdown
};

// What can be measured in a scene: all columns that its measures.csv can have, in their order, and the
// instruments, which are measurements that a scene must ask for by name.
struct Measurable {
    std::vector<MeasureColumn> columns;
    std::vector<std::string> instruments;
};
// Gives the columns for a scene that has been read except for its film.
using MeasurableIn = std::function<Measurable(const Scene&)>;

// Gives a species' name as a part of a column's name. Quotes and separators of CSV are replaced, because they
// would break the row.
inline std::string column_part(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

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

inline constexpr std::array<std::string_view, 10> kAlsoFormats{
    "netcdf", "lammps-dump", "lammps-data", "xyz", "csv", "vtk", "stl", "gsd", "gltf", "blender"};

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
