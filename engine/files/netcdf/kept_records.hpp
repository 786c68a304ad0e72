// How much of a NetCDF file stays when the run that wrote it goes on.
#pragma once

#include <cstddef>
#include <cstdint>

namespace grainreel {

struct KeptRecords {
    std::size_t records = 0;
    std::uintmax_t bytes = 0;  // of the file up to there
};

}  // namespace grainreel
