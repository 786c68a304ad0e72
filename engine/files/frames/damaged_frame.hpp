// One frame of a record is damaged.
#pragma once

#include "engine/base/error.hpp"

namespace grainreel {

// A frame whose checksum is not that of its numbers, or that holds what no run can have: NaN, a radius of 0,
// a species that is none. The other frames may well be whole.
class DamagedFrame : public UserError {
  public:
    using UserError::UserError;
};

}  // namespace grainreel
