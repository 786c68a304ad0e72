// `grainreel chart stability`: where each method fails, measured beside theory. The chart has two tables:
// limits.csv with one row for each experiment, and curves.csv with the measurements on the way to the limit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The experiments of the stability chart. Each drives one method until it fails and measures this limit, to
// be compared with the limit of theory. The source of the theory is given at each experiment.

struct CurvePoint {
    double x, value;
    double theory = kUnknown;
};

// The result of an experiment: the limit in the unit of `Experiment::varied`. If a method has an error
// instead of a limit, `theory` is the allowed error and `measured` the largest error found.
struct Finding {
    double theory = kUnknown, measured = kUnknown;
    double usual = kUnknown;  // value of the varied quantity in a usual run, if the plan chooses it
    std::vector<CurvePoint> curve;
};

// How a run fails beyond the limit. loud: the health check stops it. silent: nothing stops it; only a warning
// before the run, or the user's care, helps.
enum class Failing { loud, silent };

// stability_drawing() picks curves by the names of experiments.
struct Experiment {
    std::string name, varied;  // varied: the quantity that is varied, with its unit
    Failing failing;
    std::string guard;  // what protects a user
    std::function<Finding(bool quick)> run;
};

std::vector<Experiment> step_experiments();
std::vector<Experiment> speed_experiments();
std::vector<Experiment> restitution_experiments();
std::vector<Experiment> friction_experiments();
std::vector<Experiment> path_experiments();
std::vector<Experiment> detachment_experiments();
std::vector<Experiment> softness_experiments();
std::vector<Experiment> drive_experiments();
std::vector<Experiment> bed_experiments();
std::vector<Experiment> number_experiments();

// Finds by halving where a condition ceases to hold. It must hold at `low` and not at `high`.
template <class Holds>
double last_that_holds(double low, double high, int halvings, const Holds& holds) {
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// `count` values from low to high, evenly spread on a logarithmic axis.
inline std::vector<double> logarithmic(double low, double high, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(low * math::pow(high / low, k / (count - 1.0)));
    return values;
}

// All experiments, in the order of the tables.
std::vector<Experiment> stability_experiments();

bool run_stability(const ChartRequest& request, const ChartWatcher& watcher);
std::string stability_drawing();

// Linear stability theory: how a disturbance of a harmonic oscillator grows in one step of an integrator.

// Spectral radius of the amplification matrix of one step; `step` is step x angular frequency.
double growth_a_step(Integrator integrator, double step);

// Largest step x angular frequency at which nothing grows.
double stability_limit(Integrator integrator);

}  // namespace grainreel
