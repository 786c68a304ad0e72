// A block without restitution on a plate that moves as a sin(2 pi t), where t is in periods: when it leaves
// and when it lands.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {

// Gamma = a (2 pi)^2 / g. The block leaves at sin(2 pi t) = 1 / Gamma with the plate's velocity, and lands
// when the plate is at its place again.
struct InelasticBlock {
    double gamma, leaves, lands;  // turns; within a period of each other

    explicit InelasticBlock(double level)
        : gamma(level), leaves(std::asin(1 / level) / (2 * std::numbers::pi)) {
        double low = leaves + 0.05, high = leaves + 1.2;
        for (int i = 0; i < 60; ++i) (above_plate(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
        lands = low;
    }
    // Share of the block's weight that the plate carries.
    double carried(double turns) const {
        const double t = turns - std::floor(turns - leaves);  // since the last take-off
        return t < lands ? 0 : std::max(0.0, 1 - gamma * std::sin(2 * std::numbers::pi * t));
    }

  private:
    // Height above the plate at a time t after the take-off, divided by g times the period squared.
    double above_plate(double t) const {
        constexpr double turn = 2 * std::numbers::pi;
        const double a = gamma / (turn * turn), late = t - leaves;
        return a * (std::sin(turn * leaves) - std::sin(turn * t)) +
               turn * a * std::cos(turn * leaves) * late - late * late / 2;
    }
};

}  // namespace grainreel
