// The checksum of a sequence of numbers, by which a reader tells damage from data. XXH64, chained: what is
// added is hashed with the sum so far as its seed. Two 32-bit words, high one first, since classic NetCDF has
// no integer of 64 bits. Source: Y. Collet, xxHash fast digest algorithm, version 0.1.1.
#pragma once

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace grainreel {

class Checksum {
  public:
    // Their bytes as this machine has them, the lowest first.
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
