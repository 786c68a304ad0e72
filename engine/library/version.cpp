// The version of the library.
#include "engine/library/internal.hpp"

namespace grainreel::v1 {

std::string version() {
    return GRAINREEL_VERSION;
}

}  // namespace grainreel::v1
