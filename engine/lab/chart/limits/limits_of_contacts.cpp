// How accurate one impact is at the step that the plan chooses: restitution from nearly 0 to nearly 1, and
// sizes and masses far apart. Also what happens when the step is too long, or when impacts follow each other
// too fast.

#include <algorithm>
#include <numbers>

#include "engine/base/numbers.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/accuracy/single_contact.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/plan/damping.hpp"

namespace grainreel {

namespace {

constexpr double kAllowed = 0.005;  // error of the restitution that the accuracy `standard` allows

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

// The largest error over a range of values; `set` puts a value into the scene.
template <class Set>
Finding planned_errors(const std::vector<double>& values, bool quick, const Set& set) {
    Finding finding;
    finding.theory = kAllowed;
    finding.measured = 0;
    for (const double value : values) {
        ImpactScene impact;
        set(impact, value);
        const double error = planned_error(impact, quick ? 20 : 100);
        finding.curve.push_back({value, error, kAllowed});
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
    return planned_errors({1, 1.5, 2, 3, 5, 7, 10, 14, 20, 30, 50}, quick,
                          [](ImpactScene& impact, double ratio) { impact.size_ratio = ratio; });
}

Finding masses(bool quick) {
    return planned_errors({1, 3, 10, 30, 100, 300, 1000}, quick,
                          [](ImpactScene& impact, double ratio) { impact.density_ratio = ratio; });
}

// Change of momentum or of angular momentum, whichever is larger, in oblique impacts with friction.
Finding momenta(bool) {
    Finding finding;
    finding.theory = 1e-11;
    finding.measured = 0;
    for (const double ratio : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
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

// Error of the slip after an oblique impact, divided by the speed. The reference is the same impact with a
// hundredth of the step. Schemes that mix positions and velocities of different times go wrong here from a
// size ratio of 3 on (Vyas et al., Comput. Phys. Commun. 310, 109524).
Finding oblique_sizes(bool quick) {
    Finding finding;
    finding.theory = 1;
    finding.measured = 0;
    double equal = kUnknown;
    for (const double ratio : {1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0}) {
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

// Plain Verlet's error, the largest of 200 phases of the first touch (40 in a quick chart). `derived` has the
// numbers that were derived by hand (docs/reference/accuracy.md); the one for 12 steps must be among them.
Finding few_steps(double e, const std::vector<std::pair<int, double>>& derived, bool quick) {
    const Method plain{"", Integrator::velocity_verlet, NormalForce::walton_braun, TangentialLaw::none};
    Finding finding;
    for (const int steps : {3, 4, 5, 6, 8, 10, 12, 15, 20, 30, 40}) {
        const double error = normal_errors(plain, e, steps, quick ? 40 : 200).restitution;
        const auto known = std::find_if(derived.begin(), derived.end(),
                                        [&](const auto& figure) { return figure.first == steps; });
        finding.curve.push_back(
            {static_cast<double>(steps), error, known == derived.end() ? kUnknown : known->second});
        if (steps == 12) {
            finding.theory = known->second;
            finding.measured = error;
        }
    }
    return finding;
}

}  // namespace

std::vector<Experiment> restitution_experiments() {
    const auto silent = Failing::silent;
    const std::string plan = "the plan's step", steps = "check warns of too few steps; it prints the error";
    return {
        {"restitution 0.02 to 0.999", "largest error of e", silent, plan, restitutions},
        {"size ratio 1 to 50", "largest error of e", silent, plan, sizes},
        {"mass ratio 1 to 1000", "largest error of e", silent, plan, masses},
        {"momentum at size ratios 1 to 50", "largest change / momentum", silent, "arms to the contact plane",
         momenta},
        {"slip at size ratios 1 to 50", "largest error / that of equal grains", silent, plan, oblique_sizes},
        {"12 steps a contact (e = 0.9)", "largest error of e", silent, steps,
         [](bool quick) {
             return few_steps(0.9, {{5, .019}, {10, .0032}, {12, .0018}, {20, .0003}}, quick);
         }},
        {"12 steps a contact (e = 0.3)", "largest error of e", silent, steps, [](bool quick) {
             return few_steps(0.3, {{5, .10}, {10, .013}, {12, .0082}, {20, .0014}, {40, .0008}}, quick);
         }}};
}

// Detachment: a grain that meets the next one before it has left the last one loses too little energy. A
// column of grains falls on a plate and is compared with the same column whose contacts take no time (Luding
// et al. 1994, Phys. Rev. E 50, 4113).

namespace {

using std::numbers::pi;

PairPlan contact_of(NormalForce law, double e, double effective_mass) {
    PairPlan pair = latching_pair(bench_stiffness, e);
    pair.model.normal = law;
    if (law == NormalForce::spring_dashpot) {
        pair.unloading_stiffness = bench_stiffness;
        pair.normal_damping = 2 * std::sqrt(bench_stiffness / effective_mass) * linear_damping(e, false);
    }
    return pair;
}

constexpr int column_of = 8;
constexpr double kSpeed = 0.3;  // m/s

// A column of balls whose contacts take no time and come one after the other. Speeds are in units of the
// speed of the fall.
class HardColumn {
  public:
    HardColumn(double gap, double e) : e_(e) {
        for (int k = 0; k < column_of; ++k) {
            height_.push_back((k + 1) * gap);  // above the plate, without the diameters of the balls below
            velocity_.push_back(-1);
        }
    }
    // Kinetic energy when no more balls meet, divided by that at the start.
    double energy_left() {
        while (meet_next()) {
        }
        double sum = 0;
        for (const double v : velocity_) sum += v * v / column_of;
        return sum;
    }

  private:
    bool meet_next() {
        double soonest = std::numeric_limits<double>::infinity();
        std::size_t who = 0;
        for (std::size_t k = 0; k < velocity_.size(); ++k) {
            const double closing = (k == 0 ? 0 : velocity_[k - 1]) - velocity_[k];
            const double gap = height_[k] - (k == 0 ? 0 : height_[k - 1]);
            if (closing > 1e-12 && gap / closing < soonest) soonest = gap / closing, who = k;
        }
        if (std::isinf(soonest)) return false;
        for (std::size_t k = 0; k < velocity_.size(); ++k) height_[k] += velocity_[k] * soonest;
        if (who == 0) {
            velocity_[0] *= -e_;
        } else {
            const double below = velocity_[who - 1], above = velocity_[who];
            velocity_[who - 1] = 0.5 * ((1 - e_) * below + (1 + e_) * above);
            velocity_[who] = 0.5 * ((1 + e_) * below + (1 - e_) * above);
        }
        return true;
    }
    double e_;
    std::vector<double> height_, velocity_;
};

bool flies_apart(SmallWorld& world) {
    double below = 0;
    for (std::int32_t id = 0; id < column_of; ++id) {
        const double v = world.velocity(id).z();
        if (v < below || summarise_contacts(*world.loop, world.step).carrying > 0) return false;
        below = v;
    }
    return true;
}

double soft_energy_left(NormalForce law, double e, double gap) {
    const double time = pi / 2 * (1 + e) * std::sqrt(0.5 * bench_mass() / bench_stiffness);
    SmallWorld world(contact_of(law, e, 0.5 * bench_mass()), time / 200);
    world.plan.wall = {contact_of(law, e, bench_mass())};
    world.add_floor();
    for (int k = 0; k < column_of; ++k)
        world.add(Vec3(0, 0, bench_radius + k * 2 * bench_radius + (k + 1) * gap), Vec3(0, 0, -kSpeed));
    world.start();
    const double before = world.kinetic();
    for (int looks = 0; looks < 4000 && !(looks > 0 && flies_apart(world)); ++looks) world.run(200);
    return world.kinetic() / before;
}

Experiment detachment(NormalForce law, double e, const std::string& name) {
    return {"detachment by " + name, "time of a contact / time between impacts", Failing::silent,
            "check warns of soft contacts", [=](bool quick) {
                const double time = pi / 2 * (1 + e) * std::sqrt(0.5 * bench_mass() / bench_stiffness);
                Finding finding;
                finding.theory = 1;  // only a rough value
                for (const double gap : logarithmic(0.02, 50, quick ? 12 : 40)) {
                    const double soft = soft_energy_left(law, e, gap * time * kSpeed);
                    const double hard = HardColumn(gap, e).energy_left(), excess = soft / hard;
                    finding.curve.push_back({1 / gap, soft, hard});
                    if (excess > 1.2) finding.measured = 1 / gap;  // the last is the smallest that fails
                }
                // At an overlap of 1 % a grain crosses its own diameter in some 30 contact times.
                const Plan plan = plan_of(ImpactScene());
                finding.usual = plan.between(0, 0).contact_time * plan.impact_speed / (2 * bench_radius);
                return finding;
            }};
}

}  // namespace

std::vector<Experiment> detachment_experiments() {
    return {detachment(NormalForce::walton_braun, 0.9, "Walton-Braun"),
            detachment(NormalForce::spring_dashpot, 0.9, "dashpot")};
}

}  // namespace grainreel
