#include "engine/lab/chart/limits/scheme_growth.hpp"

#include <Eigen/Core>
#include <cmath>

#include "engine/lab/chart/limits/experiment.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {
namespace {

// Gelfand's formula, the limit of |A^n|^(1/n), with n doubled again and again.
template <class Matrix>
double spectral_radius(Matrix power) {
    double logarithm = 0, share = 1;  // of |A^n|, 1/n
    for (int doubling = 0; doubling < 48; ++doubling) {
        const double size = power.norm();
        logarithm += share * std::log(size);
        power /= size;
        power = (power * power).eval();
        share /= 2;
    }
    return std::exp(logarithm);
}

// What one step does with (x, v), where x'' = -x.
Eigen::Matrix2d kicks_and_drifts(const Scheme& scheme, double h) {
    const auto kick = [h](double share) { return Eigen::Matrix2d{{1, 0}, {-share * h, 1}}; };
    const auto drift = [h](double share) { return Eigen::Matrix2d{{1, share * h}, {0, 1}}; };
    Eigen::Matrix2d step = kick(scheme.opening_kick);
    for (const Stage& stage : scheme.stages) step = kick(stage.kick) * drift(stage.drift) * step;
    return drift(scheme.closing_drift) * step;
}

// What one step of Gear's scheme does with (x, h x', h^2 x''/2, h^3 x'''/6): Pascal's triangle predicts, 1/6,
// 5/6, 1, 1/3 correct (Allen & Tildesley, Computer Simulation of Liquids, app. E).
Eigen::Matrix4d gear(double h) {
    const Eigen::Matrix4d predicted{{1, 1, 1, 1}, {0, 1, 2, 3}, {0, 0, 1, 3}, {0, 0, 0, 1}};
    const Eigen::Vector4d weights(1.0 / 6, 5.0 / 6, 1, 1.0 / 3);
    const Eigen::RowVector4d error =
        -0.5 * h * h * predicted.row(0) - predicted.row(2);  // h^2/2 (force - x'')
    return predicted + weights * error;
}

}  // namespace

double growth_a_step(Integrator integrator, double step) {
    const Scheme scheme = scheme_of(integrator);
    return scheme.corrects ? spectral_radius(gear(step)) : spectral_radius(kicks_and_drifts(scheme, step));
}

double stability_limit(Integrator integrator) {
    constexpr double round_off = 1e-6, coarse = 0.01;
    const auto stable = [&](double step) { return growth_a_step(integrator, step) <= 1 + round_off; };
    double step = coarse;
    while (stable(step + coarse)) step += coarse;
    return last_that_holds(step, step + coarse, 40, stable);
}

}  // namespace grainreel
