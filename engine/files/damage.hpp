// Finds damage in what was read from a file: the numbers of a frame that no run can have, and a checksum that
// does not fit its numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "engine/base/error.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// The checksum of a sequence of numbers, by which a reader notices damage. It is XXH64, chained: each piece
// is hashed with the sum so far as its seed. It is kept as two words of 32 bits, the high one first, since
// classic NetCDF has no integer of 64 bits. Source: Y. Collet, xxHash fast digest algorithm, version 0.1.1.
class Checksum {
  public:
    // Adds the bytes of the numbers as they lie in memory. On the processors that this program runs on, the
    // lowest byte of a number comes first. Reader and writer must add the same pieces.
    template <class Value>
    void add(const Value* values, std::size_t count) {
        static_assert(std::is_arithmetic_v<Value>);
        add_bytes(values, count * sizeof(Value));
    }

    std::array<int, 2> words() const {
        return {static_cast<int>(static_cast<std::uint32_t>(sum_ >> 32)),
                static_cast<int>(static_cast<std::uint32_t>(sum_))};
    }

  private:
    void add_bytes(const void* bytes, std::size_t count);

    std::uint64_t sum_ = 0;
};

// The largest numbers that the grains of a frame may have. No bed of grains reaches them, and code that draws
// can still compute with them.
constexpr double kFarthestPlace = 1e6;  // m
constexpr double kLargestRadius = 1e3;  // m
constexpr double kFastest = 1e6;        // m/s
constexpr double kFastestSpin = 1e12;   // rad/s
constexpr double kLongestTime = 1e9;    // s

// The first fault of a frame as text: "its time is nan s", "grain 12 has a radius of -1 m"; none when all
// numbers are possible. moment_fault() looks at time, phase and poses, grains_fault() at the grains.
// `species` is the number of species that there are. `unknown`: whether velocities and spins may be NaN, as
// in runs of other programs.
std::optional<std::string> moment_fault(const State& frame);
std::optional<std::string> grains_fault(const State& frame, std::size_t species, bool unknown = false);

// One frame of a file is damaged: its checksum does not fit its numbers, or it has numbers that no run can
// have (NaN, a radius of 0, an unknown species). The other frames may be whole.
class DamagedFrame : public UserError {
  public:
    using UserError::UserError;
};

}  // namespace grainreel
