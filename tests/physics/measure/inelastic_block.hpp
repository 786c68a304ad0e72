// A block without restitution on a plate that moves as a sin(2 pi t), t in periods: where it leaves and
// lands.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {

// Gamma = a (2 pi)^2 / g. It leaves at sin(2 pi t) = 1 / Gamma with the plate's velocity, and is hit when the
// plate is there again.
struct InelasticBlock {
    double gamma, leaves, lands;  // turns; within a period of each other

    explicit InelasticBlock(double level)
        : gamma(level), leaves(std::asin(1 / level) / (2 * std::numbers::pi)) {
        double low = leaves + 0.05, high = leaves + 1.2;
        for (int i = 0; i < 60; ++i) (above_plate(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
        lands = low;
    }
    // The share of its weight that the plate carries.
    double carried(double turns) const {
        const double t = turns - std::floor(turns - leaves);  // since the last take-off
        return t < lands ? 0 : std::max(0.0, 1 - gamma * std::sin(2 * std::numbers::pi * t));
    }

  private:
    // Over g times the period squared, at t behind the take-off.
    double above_plate(double t) const {
        constexpr double turn = 2 * std::numbers::pi;
        const double a = gamma / (turn * turn), late = t - leaves;
        return a * (std::sin(turn * leaves) - std::sin(turn * t)) +
               turn * a * std::cos(turn * leaves) * late - late * late / 2;
    }
};

}  // namespace grainreel
