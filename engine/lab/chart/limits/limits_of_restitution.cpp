// How well one impact is kept at the step that the plan chooses: restitution from nearly 0 to nearly 1, sizes
// and masses far apart; and what becomes of it when the step is too long.
#include <algorithm>

#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/accuracy/single_contact.hpp"
#include "engine/lab/chart/limits/experiment.hpp"

namespace grainreel {
namespace {

constexpr double allowed = 0.005;  // error of the restitution that `standard` aims at

double planned_error(const ImpactScene& impact, int phases) {
    const Plan plan = plan_of(impact);
    double worst = 0;
    for (int phase = 0; phase < phases; ++phase) {
        const Impact after = make_impact(impact, plan, plan.clock.step, 0, (phase + 0.5) / phases);
        const double e = (after.velocity[1].x() - after.velocity[0].x()) / impact.speed;
        worst = std::max(worst, std::abs(e - impact.restitution));
    }
    return worst;
}

// The largest error over a range; `set` puts the value into the scene.
template <class Set>
Finding planned_errors(const std::vector<double>& values, bool quick, const Set& set) {
    Finding finding;
    finding.theory = allowed;
    finding.measured = 0;
    for (const double value : values) {
        ImpactScene impact;
        set(impact, value);
        const double error = planned_error(impact, quick ? 20 : 100);
        finding.curve.push_back({value, error, allowed});
        finding.measured = std::max(finding.measured, error);
    }
    return finding;
}

Finding restitutions(bool quick) {
    return planned_errors(
        {0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999},
        quick, [](ImpactScene& impact, double e) { impact.restitution = e; });
}

Finding sizes(bool quick) {
    return planned_errors({1, 1.5, 2, 3, 5, 7, 10, 14, 20}, quick,
                          [](ImpactScene& impact, double ratio) { impact.size_ratio = ratio; });
}

Finding masses(bool quick) {
    return planned_errors({1, 3, 10, 30, 100, 300, 1000}, quick,
                          [](ImpactScene& impact, double ratio) { impact.density_ratio = ratio; });
}

// Momentum and angular momentum (the larger change of the two) in oblique impacts with friction.
Finding momenta(bool) {
    Finding finding;
    finding.theory = 1e-11;
    finding.measured = 0;
    for (const double ratio : {1.0, 2.0, 5.0, 10.0, 20.0}) {
        ImpactScene impact;
        impact.friction = 0.5;
        impact.size_ratio = ratio;
        const Plan plan = plan_of(impact);
        double worst = 0;
        for (double angle = 0; angle < 1.5; angle += 0.1) {
            const Impact after = make_impact(impact, plan, plan.clock.step, angle, 0.5);
            worst = std::max({worst, after.momentum_change, after.angular_change});
        }
        finding.curve.push_back({ratio, worst, finding.theory});
        finding.measured = std::max(finding.measured, worst);
    }
    return finding;
}

// The slip that an oblique impact leaves, against the same with a hundredth of the step; over the speed.
// Schemes that mix time levels go wrong here from a ratio of 3 on (Vyas et al., Comput. Phys. Commun. 310,
// 109524).
Finding oblique_sizes(bool quick) {
    Finding finding;
    finding.theory = 1;
    finding.measured = 0;
    double equal = unknown;
    for (const double ratio : {1.0, 2.0, 3.0, 5.0, 10.0, 20.0}) {
        ImpactScene impact;
        impact.friction = 0.5;
        impact.size_ratio = ratio;
        const Plan plan = plan_of(impact);
        const auto slip = [&](double step, double angle, double phase) {
            const Impact after = make_impact(impact, plan, step, angle, phase);
            return after.velocity[0].y() - after.velocity[1].y() +
                   bench_radius * (after.spin[0].z() + ratio * after.spin[1].z());
        };
        double worst = 0;
        for (double angle = 0.1; angle < 1.5; angle += quick ? 0.3 : 0.1) {
            const double right = slip(plan.clock.step / 100, angle, 0.5);
            for (const double phase : {0.1, 0.4, 0.7, 1.0})
                worst = std::max(worst, std::abs(slip(plan.clock.step, angle, phase) - right) / impact.speed);
        }
        if (ratio == 1) equal = worst;
        finding.curve.push_back({ratio, worst, equal});
        finding.measured = std::max(finding.measured, worst / equal);
    }
    return finding;
}

// Plain Verlet, largest over 200 phases, against the figures that were derived by hand
// (docs/reference/accuracy.md).
Finding few_steps(double e, const std::vector<std::pair<int, double>>& derived, bool quick) {
    const Method plain{"", Integrator::velocity_verlet, NormalForce::walton_braun, TangentialLaw::none};
    Finding finding;
    for (const int steps : {3, 4, 5, 6, 8, 10, 12, 15, 20, 30, 40}) {
        const double error = normal_errors(plain, e, steps, quick ? 40 : 200).restitution;
        const auto known = std::find_if(derived.begin(), derived.end(),
                                        [&](const auto& figure) { return figure.first == steps; });
        finding.curve.push_back(
            {static_cast<double>(steps), error, known == derived.end() ? unknown : known->second});
        if (steps == 12) {
            finding.theory = known->second;
            finding.measured = error;
        }
    }
    return finding;
}

}  // namespace

std::vector<Experiment> restitution_experiments() {
    const auto silent = Failure::silent;
    const std::string plan = "the plan's step", steps = "check warns of too few steps; it prints the error";
    return {
        {"restitution 0.02 to 0.999", "largest error of e", silent, plan, restitutions},
        {"size ratio 1 to 20", "largest error of e", silent, plan, sizes},
        {"mass ratio 1 to 1000", "largest error of e", silent, plan, masses},
        {"momentum at size ratios 1 to 20", "largest change / momentum", silent, "arms to the contact plane",
         momenta},
        {"slip at size ratios 1 to 20", "largest error / that of equal grains", silent, plan, oblique_sizes},
        {"12 steps a contact (e = 0.9)", "largest error of e", silent, steps,
         [](bool quick) {
             return few_steps(0.9, {{5, .019}, {10, .0032}, {12, .0018}, {20, .0003}}, quick);
         }},
        {"12 steps a contact (e = 0.3)", "largest error of e", silent, steps, [](bool quick) {
             return few_steps(0.3, {{5, .10}, {10, .013}, {12, .0082}, {20, .0014}, {40, .0008}}, quick);
         }}};
}

}  // namespace grainreel
