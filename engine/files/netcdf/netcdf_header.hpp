// The header of a classic NetCDF file (CDF-1, 2 and 5), read by the format's specification before the library
// sees the file. The library trusts a header: it asks for as much memory as a count says, and reads zeros
// beyond the end of a file that was cut off.
#pragma once

#include <cstdint>
#include <filesystem>

namespace grainreel {

struct NetcdfHeader {
    std::uint64_t begin = 0;   // bytes before the first record; of the whole file where none has records
    std::uint64_t record = 0;  // bytes a record; 0 where no variable has records
};

// Every count, name, type and offset is held against the format and the file's size. Throws UserError when
// the file cannot be opened, is not of a classic format, or its header contradicts itself.
NetcdfHeader read_netcdf_header(const std::filesystem::path& path);

}  // namespace grainreel
