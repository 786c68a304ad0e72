// Checks that enough address space is left before drawing begins. The libraries that draw words and pictures
// end the process when a limit of address space (`ulimit -v`) stops them. So they are not called where little
// is left.
#pragma once

#include <sys/mman.h>
#include <cstddef>

#include "engine/base/error.hpp"

namespace grainreel {

// Bytes of addresses that a small film takes: 467 MB were measured, in a process that had 211 MB before. Half
// of that goes to threads of the raster and the encoder before the context is made.
inline constexpr std::size_t kAddressesOfFilm = 600'000'000;
inline constexpr std::size_t kAddressesOfContext = 240'000'000;
inline constexpr std::size_t kAddressesOfFonts = 128'000'000;

// Whether so many bytes of addresses are still free. They run out only under a limit.
inline bool has_addresses(std::size_t bytes) {
    void* const room = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return false;
    ::munmap(room, bytes);
    return true;
}

// Throws RunError if so many bytes of addresses are not free.
inline void need_addresses(std::size_t bytes) {
    if (has_addresses(bytes)) return;
    throw RunError(
        "pictures need {} MB of address space more, and a limit (ulimit -v) leaves less; raise the limit",
        bytes / 1'000'000);
}

}  // namespace grainreel
