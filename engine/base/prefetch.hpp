// A line of memory asked for ahead.
#pragma once

namespace grainreel {

// To write to it: another processor that has the line gives it up. (GCC's __builtin_prefetch has an
// instruction for this only where the processor is known not to be older than 2014, when it does nothing.)
[[gnu::always_inline]] inline void fetch_to_write(const void* at) {
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(at)));
#else
    __builtin_prefetch(at, 1);
#endif
}

}  // namespace grainreel
