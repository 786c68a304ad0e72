// Whether the numbers of a frame that was read from a file can be those of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/frame.hpp"

namespace grainreel {

// The first thing wrong: "its time is nan s", "grain 12 has a radius of -1 m"; none when all is possible.
// What is wrong with time, phase and pose, and with the grains of so many species; empty for nothing.
std::optional<std::string> moment_fault(const Frame& frame);
std::optional<std::string> grains_fault(const Frame& frame, std::size_t species);

// One frame of a record is damaged.

// A frame whose checksum is not that of its numbers, or that holds what no run can have: NaN, a radius of 0,
// a species that is none. The other frames may well be whole.
class DamagedFrame : public UserError {
  public:
    using UserError::UserError;
};

}  // namespace grainreel
