// What a card does in instructions of its own: counts and maxima that many threads make together. Their order
// does not matter.
#pragma once

#include <cstdint>

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE void add_one(std::int64_t& count) {
    __atomic_fetch_add(&count, std::int64_t{1}, __ATOMIC_RELAXED);
}

// Raises `most` to the bits of a number that is not below zero.
HWY_INLINE void raise(std::uint64_t& most, double x) {
    const auto bits = __builtin_bit_cast(std::uint64_t, x);
    std::uint64_t seen = __atomic_load_n(&most, __ATOMIC_RELAXED);
    while (bits > seen &&
           !__atomic_compare_exchange_n(&most, &seen, bits, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
