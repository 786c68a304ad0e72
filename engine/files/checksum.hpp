// The checksum of a sequence of numbers, by which a reader notices damage. It is XXH64, chained: each piece
// is hashed with the sum so far as its seed. It is kept as two words of 32 bits, the high one first, since
// classic NetCDF has no integer of 64 bits. Source: Y. Collet, xxHash fast digest algorithm, version 0.1.1.
#pragma once

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace grainreel {

class Checksum {
  public:
    // Adds the bytes of the numbers as they lie in memory: the lowest byte of each first on the processors
    // that this program runs on. Reader and writer must add the same pieces.
    template <class Value>
    void add(const Value* values, std::size_t count) {
        static_assert(std::is_arithmetic_v<Value>);
        sum_ = XXH64(values, count * sizeof(Value), sum_);
    }

    std::array<int, 2> words() const {
        return {static_cast<int>(static_cast<std::uint32_t>(sum_ >> 32)),
                static_cast<int>(static_cast<std::uint32_t>(sum_))};
    }

  private:
    std::uint64_t sum_ = 0;
};

}  // namespace grainreel
