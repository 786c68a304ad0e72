// Round numbers for axes, and their words.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace grainreel {

// Multiples of 1, 2 or 5 times a power of ten inside [low, high]: as many as there are, at most `most` (>=
// 2).
std::vector<double> round_ticks(double low, double high, int most);

// The ticks of an axis from `low` to `high`, and the distance that their decimals follow.
struct AxisTicks {
    std::vector<double> at;
    double distance = 1;
};
// At most `most` (>= 2) round ticks. Where only one of them lies inside, and one does not make an axis, the
// first and the last of up to `finest` round ticks.
AxisTicks axis_ticks(double low, double high, int most, int finest);

// Ticks of an axis that goes by ratios, low > 0: powers of ten, so many apart that there are at most `most`
// (>= 2); where less than two lie inside, 2 and 5 times them too.
std::vector<double> power_ticks(double low, double high, int most);

// The narrowest interval around [low, high] whose ends are such multiples, `most` of them at most. Equal ends
// are taken a little apart.
std::array<double, 2> round_limits(double low, double high, int most);

// As many decimals as the distance between ticks asks for, a minus as wide as a digit.
std::string tick_text(double value, double distance);

}  // namespace grainreel
