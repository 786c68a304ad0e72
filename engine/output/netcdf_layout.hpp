// How a classic NetCDF file lies on disk, by the format's specification (NetCDF classic format, CDF-1, 2 and
// 5). The library reads zeros where such a file has been cut off; with this the missing part shows.
#pragma once

#include <cstdint>
#include <optional>

namespace grainreel {

struct NetcdfLayout {
    std::uint64_t begin = 0;   // bytes before the first record: header and variables without records
    std::uint64_t record = 0;  // bytes a record
};

// Of an open file, as this library lays it out; none for formats that are not classic (NetCDF-4).
std::optional<NetcdfLayout> netcdf_layout(int file);

}  // namespace grainreel
