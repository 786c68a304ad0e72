#include "engine/handover/carry.hpp"

namespace grainreel {

double tsuji_damping(double e) {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

// The polynomial falls all the way.
std::optional<double> tsuji_restitution(double alpha) {
    double low = -0.5, high = 1;
    if (alpha > tsuji_damping(low)) return std::nullopt;
    if (alpha <= tsuji_damping(high)) return high;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (tsuji_damping(middle) > alpha ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace grainreel
