#include "engine/plan/damping.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include "engine/base/mathematics.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// Where a damping is known to lie: up to `low` the restitution is larger than wanted, from `high` on it is
// not.
struct Bracket {
    double low = 0, high = std::numeric_limits<double>::infinity();
};

// The damping in [0, most] at which the restitution, which falls with the damping, takes the wanted value. It
// is found by sixty halvings. The bracket `known` saves computing restitutions; the result is the same, bit
// for bit.
template <class Restitution>
double solve(double wanted, double most, const Restitution& restitution, const Bracket& known = {}) {
    double low = 0, high = most;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) return middle;
        const bool larger = middle <= known.low || (middle < known.high && restitution(middle) > wanted);
        (larger ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The dashpot may pull: beta / sqrt(1 - beta^2) = -ln e / pi gives beta.
double logarithmic(double restitution) {
    const double logarithm = -math::log(restitution);
    return logarithm / std::sqrt(pi * pi + logarithm * logarithm);
}

}  // namespace

double linear_restitution(double beta, bool attraction) {
    if (beta == 0) return 1;
    const double rest = std::sqrt(std::abs(1 - beta * beta));
    if (attraction) return beta < 1 ? math::exp(-pi * beta / rest) : 0;
    if (rest < 1e-6) return math::exp(-2);
    if (beta < 1) return math::exp(-beta / rest * (pi - math::atan2(2 * beta * rest, 1 - 2 * beta * beta)));
    return math::exp(-beta / rest * math::log((beta + rest) / (beta - rest)));
}

double linear_damping(double restitution, bool attraction) {
    if (restitution == 1) return 0;
    if (attraction) return logarithmic(restitution);
    return solve(restitution, 1 / restitution, [](double beta) { return linear_restitution(beta, false); });
}

namespace {

// Integrates x'' = -x^(3/2) - d x^(1/4) x' from x = 0, x' = 1 by the classical Runge-Kutta method, until
// the force ends.
struct HertzImpact {
    double restitution = 0;
    int steps = 0;
};

HertzImpact hertz_impact(double damping) {
    const auto push = [&](double x, double v) {
        return x <= 0 ? 0 : -math::pow(x, 1.5) - damping * math::pow(x, 0.25) * v;
    };
    constexpr double h = 1e-3;
    double x = 0, v = 1;
    int step = 0;
    for (; step < 20000; ++step) {
        const double a1 = push(x, v), v2 = v + 0.5 * h * a1;
        if (x > 0 && a1 >= 0) break;
        const double a2 = push(x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
        const double a3 = push(x + 0.5 * h * v2, v3), v4 = v + h * a3;
        const double a4 = push(x + h * v3, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (x <= 0) break;
    }
    return {v < 0 ? -v : 0, step};
}

// Finds a damping close to that of the wanted restitution, by secants from two guesses.
double approach(double restitution, double before, double at) {
    double error_before = hertz_impact(before).restitution - restitution;
    for (int look = 0; look < 12; ++look) {
        const double error = hertz_impact(at).restitution - restitution;
        if (std::abs(error) < 1e-14 || error == error_before) break;
        const double next = at - error * (at - before) / (error - error_before);
        before = std::exchange(at, next);
        error_before = error;
    }
    return at;
}

// The narrowest bracket that certainly holds the wanted damping. The integration ends with a whole step, so
// the restitution jumps by up to 1e-6 where the number of steps changes. The wide bracket is wide enough for
// such jumps. The narrow one is just wider than rounding, and is certain if no jump lies within the wide one.
Bracket hertz_bracket(double restitution, double damping) {
    constexpr double wide = 1e-5, narrow = 3e-13;  // as a share of the damping
    Bracket known;
    for (const double share : {wide, narrow}) {
        const Bracket next{damping * (1 - share), damping * (1 + share)};
        const HertzImpact low = hertz_impact(next.low), high = hertz_impact(next.high);
        if (!(low.restitution > restitution) || high.restitution > restitution) break;
        known = next;
        if (low.steps != high.steps) break;
    }
    return known;
}

double integrated_hertz_damping(double restitution) {
    const double pulling = hertz_damping(restitution, true);
    const double close = approach(restitution, pulling, 1.05 * pulling);
    return solve(
        restitution, 4 / restitution, [](double d) { return hertz_impact(d).restitution; },
        hertz_bracket(restitution, close));
}

}  // namespace

double hertz_restitution(double damping, bool attraction) {
    if (attraction) {  // d = sqrt(5) b, b = -ln e / sqrt(pi^2 + ln^2 e)
        const double b = damping / std::sqrt(5);
        return b < 1 ? math::exp(-pi * b / std::sqrt(1 - b * b)) : 0;
    }
    return hertz_impact(damping).restitution;
}

double hertz_contact_time(double mass, double k, double speed) {
    constexpr double duration = 2.9432;
    return duration * math::pow(1.25 * mass / k, 0.4) * math::pow(speed, -0.2);
}

double hertz_damping(double restitution, bool attraction) {
    if (restitution == 1) return 0;
    if (attraction) return std::sqrt(5) * logarithmic(restitution);
    // A scene has few restitutions but many kinds of contact, so found dampings are kept.
    static std::mutex turn;
    static std::map<double, double> found;
    const std::lock_guard lock(turn);
    const auto known = found.find(restitution);
    if (known != found.end()) return known->second;
    return found[restitution] = integrated_hertz_damping(restitution);
}

}  // namespace grainreel
