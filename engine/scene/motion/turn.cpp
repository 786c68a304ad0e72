#include "engine/scene/motion/turn.hpp"

#include <algorithm>

namespace grainreel {

namespace {

// The ramp 10u^3 - 15u^4 + 6u^5 and its integral from 0, u in [0, 1].
double ramp(double u) {
    return u * u * u * (10 + u * (6 * u - 15));
}
double ramp_integral(double u) {
    return u * u * u * u * (2.5 + u * (u - 3));
}

// How much of a rise of `over` seconds from `begin` on is there at `time`, and its integral over time (s).
double share_at(double begin, double over, double time) {
    if (time < begin) return 0;
    return over > 0 ? ramp(std::min(1.0, (time - begin) / over)) : 1;
}
double integral_at(double begin, double over, double time) {
    const double passed = std::max(0.0, time - begin);
    if (passed >= over) return passed - 0.5 * over;
    return over * ramp_integral(passed / over);
}

}  // namespace

double BodyTurn::rate_at(double time) const {
    return rate * (share_at(from, over, time) - share_at(until, over, time));
}

double BodyTurn::angle_at(double time) const {
    const double falls = std::min(time, until) < time ? integral_at(until, over, time) : 0;
    return rate * (integral_at(from, over, time) - falls);
}

}  // namespace grainreel
