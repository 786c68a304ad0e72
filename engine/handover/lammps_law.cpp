#include "engine/handover/decks.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/handover/carry.hpp"

namespace grainreel {

std::string lammps_law(const CarriedPair& pair) {
    const bool hertz = pair.law == CarriedLaw::hertz;
    GRAINREEL_CHECK(hertz || pair.law == CarriedLaw::spring_dashpot);
    // It divides by the tangential stiffness, also where nothing rubs.
    const double tangential = pair.tangential > 0 ? pair.tangential : 2.0 / 7 * pair.stiffness;
    // With Hertz tangential_damping is the share already.
    const double share = hertz              ? pair.tangential_damping
                         : pair.damping > 0 ? pair.tangential_damping / pair.damping
                                            : 0;
    std::string text =
        hertz ? fmt::format("hertz {} {} tangential mindlin_rescale/force", pair.stiffness,
                            tsuji_restitution(pair.damping).value_or(1))
              : fmt::format("hooke {} {} tangential linear_history", pair.stiffness, pair.damping);
    text += fmt::format(" {} {} {}", tangential, share, pair.friction);
    if (pair.rolling > 0) text += fmt::format(" rolling sds {} 0.0 {}", tangential, pair.rolling);
    text += hertz ? " damping tsuji" : " damping mass_velocity";
    if (!pair.attraction) text += " limit_damping";
    return text;
}

}  // namespace grainreel
