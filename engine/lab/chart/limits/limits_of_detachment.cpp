// Detachment: grains that meet the next before they have left the last lose too little energy. A column that
// falls on a plate, against the same with contacts of no length (Luding et al. 1994, Phys. Rev. E 50, 4113).
#include <algorithm>
#include <numbers>

#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/bench.hpp"
#include "engine/lab/chart/limits/experiment.hpp"
#include "engine/plan/damping.hpp"

namespace grainreel {
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
constexpr double speed = 0.3;  // m/s

// Speeds of balls that meet instantly, one after the other.
class HardColumn {
  public:
    HardColumn(double gap, double e) : e_(e) {
        for (int k = 0; k < column_of; ++k) {
            height_.push_back((k + 1) * gap);  // over the plate, less all diameters below
            velocity_.push_back(-1);
        }
    }
    // Kinetic energy over that before, once nothing meets any more.
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

bool flies_apart(Bench& bench) {
    double below = 0;
    for (std::int32_t id = 0; id < column_of; ++id) {
        const double v = bench.velocity(id).z();
        if (v < below || summarise_contacts(*bench.loop, bench.step).carrying > 0) return false;
        below = v;
    }
    return true;
}

double soft_energy_left(NormalForce law, double e, double gap) {
    const double time = pi / 2 * (1 + e) * std::sqrt(0.5 * bench_mass() / bench_stiffness);
    Bench bench(contact_of(law, e, 0.5 * bench_mass()), time / 200);
    bench.plan.wall = {contact_of(law, e, bench_mass())};
    bench.add_floor();
    for (int k = 0; k < column_of; ++k)
        bench.add(Vec3(0, 0, bench_radius + k * 2 * bench_radius + (k + 1) * gap), Vec3(0, 0, -speed));
    bench.start();
    const double before = bench.kinetic();
    for (int looks = 0; looks < 4000 && !(looks > 0 && flies_apart(bench)); ++looks) bench.run(200);
    return bench.kinetic() / before;
}

Experiment detachment(NormalForce law, double e, const std::string& name) {
    return {"detachment by " + name, "time of a contact / time between impacts", Failure::silent,
            "check warns of soft contacts", [=](bool quick) {
                const double time = pi / 2 * (1 + e) * std::sqrt(0.5 * bench_mass() / bench_stiffness);
                Finding finding;
                finding.theory = 1;  // about
                for (const double gap : logarithmic(0.02, 50, quick ? 12 : 40)) {
                    const double soft = soft_energy_left(law, e, gap * time * speed);
                    const double hard = HardColumn(gap, e).energy_left(), excess = soft / hard;
                    finding.curve.push_back({1 / gap, soft, hard});
                    if (excess > 1.2) finding.measured = 1 / gap;  // the shortest contact that fails
                }
                // At 1 % of overlap a grain crosses its own diameter in some 30 times of a contact.
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
