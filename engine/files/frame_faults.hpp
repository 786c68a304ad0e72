// Checks whether the numbers of a frame that was read from a file can be those of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/frame.hpp"

namespace grainreel {

// The first fault of a frame as text: "its time is nan s", "grain 12 has a radius of -1 m"; none when all
// numbers are possible. moment_fault() looks at time, phase and poses, grains_fault() at the grains. species:
// how many there are.
std::optional<std::string> moment_fault(const Frame& frame);
std::optional<std::string> grains_fault(const Frame& frame, std::size_t species);

// One frame of a file is damaged: its checksum does not fit its numbers, or it has numbers that no run can
// have (NaN, a radius of 0, an unknown species). The other frames may be whole.
class DamagedFrame : public UserError {
  public:
    using UserError::UserError;
};

}  // namespace grainreel
