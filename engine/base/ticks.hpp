// The processor's own clock: cheap to read, in ticks of no known length, for shares of time only.
#pragma once

#include <chrono>
#include <cstdint>

namespace grainreel {

inline std::uint64_t ticks() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

}  // namespace grainreel
