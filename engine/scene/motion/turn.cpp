#include "engine/scene/motion/turn.hpp"

#include <algorithm>

#include "engine/base/numbers.hpp"

namespace grainreel {

namespace {

// How much of a rise of `over` seconds from `begin` on is there at `time`, and its integral over time (s).
double share_at(double begin, double over, double time) {
    if (time < begin) return 0;
    return over > 0 ? smooth_step::value(std::min(1.0, (time - begin) / over)) : 1;
}
double integral_at(double begin, double over, double time) {
    const double passed = std::max(0.0, time - begin);
    if (passed >= over) return passed - 0.5 * over;
    return over * smooth_step::area(passed / over);
}

}  // namespace

double BodyTurn::rate_at(double time) const {
    return rate * (share_at(from, over, time) - share_at(until, over, time));
}

double BodyTurn::angle_at(double time) const {
    return rate * (integral_at(from, over, time) - integral_at(until, over, time));
}

}  // namespace grainreel
