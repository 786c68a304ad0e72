#include "engine/measure/segregation/big_and_small.hpp"

#include "engine/base/error.hpp"

namespace grainreel {

BigAndSmall big_and_small(const std::vector<Species>& species) {
    GRAINREEL_CHECK(species.size() > 1);
    BigAndSmall kinds;
    for (std::size_t s = 1; s < species.size(); ++s) {
        if (species[s].diameter.mean > species[kinds.big].diameter.mean) kinds.big = s;
        if (species[s].diameter.mean < species[kinds.small].diameter.mean) kinds.small = s;
    }
    if (kinds.big == kinds.small) kinds.small = 1;
    return kinds;
}

}  // namespace grainreel
