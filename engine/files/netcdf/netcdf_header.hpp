// Reads and checks the header of a classic NetCDF file (CDF-1, 2 and 5) before the library opens it. The
// library trusts a header: it asks for as much memory as a count says, and it reads zeros beyond the end of a
// file that was cut off.
#pragma once

#include <cstdint>
#include <filesystem>

namespace grainreel {

struct NetcdfHeader {
    std::uint64_t begin = 0;   // bytes before the first record, or of the whole file without records
    std::uint64_t record = 0;  // bytes of a record, or 0 where no variable has records
};

// Checks every count, name, type and offset against the format and the file's size. Throws UserError when the
// file cannot be opened, is not of a classic format or has a header that contradicts itself.
NetcdfHeader read_netcdf_header(const std::filesystem::path& path);

}  // namespace grainreel
