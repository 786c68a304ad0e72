#include "engine/scene/damping.hpp"

#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

using std::numbers::pi;

// The damping in [0, most] at which a restitution that falls with it takes the wanted value.
template <class Restitution>
double solve(double wanted, double most, const Restitution& restitution) {
    double low = 0, high = most;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (restitution(middle) > wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// -ln e of the dashpot that pulls, over pi: beta / sqrt(1 - beta^2).
double logarithmic(double restitution) {
    const double logarithm = -std::log(restitution);
    return logarithm / std::sqrt(pi * pi + logarithm * logarithm);
}

}  // namespace

double linear_restitution(double beta, bool attraction) {
    if (beta == 0) return 1;
    const double rest = std::sqrt(std::abs(1 - beta * beta));
    if (attraction) return beta < 1 ? std::exp(-pi * beta / rest) : 0;
    if (rest < 1e-6) return std::exp(-2);
    if (beta < 1) return std::exp(-beta / rest * (pi - std::atan2(2 * beta * rest, 1 - 2 * beta * beta)));
    return std::exp(-beta / rest * std::log((beta + rest) / (beta - rest)));
}

double linear_damping(double restitution, bool attraction) {
    if (restitution == 1) return 0;
    if (attraction) return logarithmic(restitution);
    return solve(restitution, 1 / restitution, [](double beta) { return linear_restitution(beta, false); });
}

// x'' = -x^(3/2) - d x^(1/4) x' from x = 0, x' = 1, by the classical Runge-Kutta method.
double hertz_restitution(double damping, bool attraction) {
    if (attraction) {  // d = sqrt(5) b, b = -ln e / sqrt(pi^2 + ln^2 e)
        const double b = damping / std::sqrt(5);
        return b < 1 ? std::exp(-pi * b / std::sqrt(1 - b * b)) : 0;
    }
    const auto push = [&](double x, double v) {
        return x <= 0 ? 0 : -std::pow(x, 1.5) - damping * std::pow(x, 0.25) * v;
    };
    constexpr double h = 1e-3;
    double x = 0, v = 1;
    for (int step = 0; step < 20000; ++step) {
        if (x > 0 && push(x, v) >= 0) break;
        const double a1 = push(x, v), v2 = v + 0.5 * h * a1;
        const double a2 = push(x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
        const double a3 = push(x + 0.5 * h * v2, v3), v4 = v + h * a3;
        const double a4 = push(x + h * v3, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (x <= 0) break;
    }
    return v < 0 ? -v : 0;
}

double hertz_contact_time(double mass, double k, double speed) {
    constexpr double duration = 2.9432;
    return duration * std::pow(1.25 * mass / k, 0.4) * std::pow(speed, -0.2);
}

double hertz_damping(double restitution, bool attraction) {
    if (restitution == 1) return 0;
    if (attraction) return std::sqrt(5) * logarithmic(restitution);
    return solve(restitution, 4 / restitution, [](double d) { return hertz_restitution(d, false); });
}

}  // namespace grainreel
