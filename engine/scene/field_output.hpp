// What a scene says of the fields that are kept in fields.nc. Plain values in SI units.
#pragma once

#include <optional>

namespace grainreel {

struct FieldOutput {
    // none: no fields; yz: means over the depth; xyz: in three dimensions.
    enum class Grid { none, yz, xyz };
    enum class Kernel { gaussian, lucy };
    Grid grid = Grid::none;
    Kernel kernel = Kernel::gaussian;
    double width = 0;             // m, the kernel's standard deviation along one axis
    double cell = 0;              // m, largest side of a cell
    int periods = 10;             // of the drive, that one record is the mean of; 0 without a drive
    int samples = 16;             // moments in each period; without a drive in each record
    std::optional<double> phase;  // turns; one moment a period, in place of `samples`
    double interval = 0;          // s, of one record without a drive; else 0

    bool wanted() const { return grid != Grid::none; }
    bool operator==(const FieldOutput&) const = default;
};

}  // namespace grainreel
