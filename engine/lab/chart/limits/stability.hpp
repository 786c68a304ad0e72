// `grainreel chart stability`: where each method fails, measured beside theory. Two tables: limits.csv, a row
// an experiment, and curves.csv, how it comes to that.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/lab/chart/chart.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The experiments of the stability chart: each takes one method to where it fails and measures that, beside
// what theory says (sources stand by each experiment).

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct CurvePoint {
    double x, value;
    double theory = unknown;
};

// The limit in the unit of `Experiment::varied`. Where a method has no limit but an error, theory is the
// error allowed and measured the largest one found.
struct Finding {
    double theory = unknown, measured = unknown;
    double usual = unknown;  // where a run with the plan's choices stands, where they decide
    std::vector<CurvePoint> curve;
};

// Loud: the health check stops the run. Silent: nothing but a warning before it, or care, helps.
enum class Failure { loud, silent };

struct Experiment {
    std::string name, varied;  // varied: the quantity, with its unit
    Failure failure;
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

// Where a condition that holds at `low` and not at `high` ceases to hold.
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
    for (int k = 0; k < count; ++k) values.push_back(low * std::pow(high / low, k / (count - 1.0)));
    return values;
}

// All, in the order of the tables.
std::vector<Experiment> stability_experiments();

bool run_stability(const ChartRequest& request, const ChartWatcher& watcher);
std::string stability_drawing();

// How a disturbance grows in one step of an integrator, for a harmonic oscillator: linear stability theory.

// Spectral radius of one step's amplification matrix at this step x angular frequency.
double growth_a_step(Integrator integrator, double step);

// Largest step x angular frequency up to which nothing grows.
double stability_limit(Integrator integrator);

}  // namespace grainreel
