// Oblique impacts with friction from none to infinite, at walls and in corners: no impact gains energy, and
// the results agree with the formulas of sticking and of sliding. (In a widely used engine, wall friction
// with history could add 34 % of kinetic energy at a grazing impact, with friction 0.5 and 76 degrees from
// the normal, as of 2026.)

#include <algorithm>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/rotation.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/small_world.hpp"

namespace grainreel {

namespace {

using std::numbers::pi;

constexpr double kGain = 1;  // most that the energy after an impact, divided by that before, may be
const std::vector<double> kPhases = {0.05, 0.25, 0.45, 0.65, 0.85};

ImpactScene on_wall(double restitution, double friction) {
    ImpactScene impact;
    impact.restitution = restitution;
    impact.friction = friction;
    impact.wall = true;
    return impact;
}

double energy_ratio(const ImpactScene& impact, const Plan& plan, double angle) {
    double largest = 0;
    for (const double phase : kPhases) {
        const Impact after = make_impact(impact, plan, plan.clock.step, angle, phase);
        largest = std::max(largest, after.energy / after.energy_before);
    }
    return largest;
}

Finding gain_by_friction(bool) {
    Finding finding;
    finding.theory = kGain;
    finding.measured = 0;
    for (const double friction : {0.0, 0.1, 0.3, 0.5, 1.0, 2.0, 10.0, 1e3, 1e6}) {
        double largest = 0;
        for (const bool wall : {false, true}) {
            ImpactScene impact = on_wall(0.9, friction);
            impact.wall = wall;
            const Plan plan = plan_of(impact);
            for (int degrees = 0; degrees <= 88; degrees += 4)
                largest = std::max(largest, energy_ratio(impact, plan, degrees * pi / 180));
        }
        finding.curve.push_back({std::max(friction, 0.01), largest, kGain});
        finding.measured = std::max(finding.measured, largest);
    }
    return finding;
}

// The slip after an impact divided by that before, at 45 degrees and a hundredth of the step.
Finding sticking(bool) {
    constexpr double e = 0.9, ratio = 0.8;  // K0/K1 by default
    const double stuck = math::cos(std::sqrt(3.5 * ratio) * pi / 2 * (1 + e));
    Finding finding;
    finding.theory = stuck;
    for (const double friction : logarithmic(0.01, 1e6, 17)) {
        ImpactScene impact = on_wall(e, friction);
        const Plan plan = plan_of(impact);
        impact.speed /= 100;  // the formula holds for a small overlap
        const Impact after = make_impact(impact, plan, plan.clock.step / 100, pi / 4, 0.5);
        const double slip =
            (after.velocity[0].y() + bench_radius * after.spin[0].z()) / (impact.speed * math::sin(pi / 4));
        const double slid = 1 - 3.5 * friction * (1 + e);  // if it slides all the time (small friction)
        finding.curve.push_back({friction, slip, friction < 0.12 ? slid : friction > 100 ? stuck : kUnknown});
        finding.measured = slip;
    }
    return finding;
}

// Energy after an impact that slides all the time: Delta v_t = mu (1 + e) v_n, r Delta omega = 2.5 Delta v_t.
double sliding_energy(double e, double friction, double angle) {
    const double push = friction * (1 + e) * math::cos(angle);
    return math::square(e * math::cos(angle)) + math::square(math::sin(angle) - push) +
           0.4 * math::square(2.5 * push);
}

Finding grazing_at_a_wall(double e) {
    constexpr double friction = 0.5;
    const ImpactScene impact = on_wall(e, friction);
    const Plan plan = plan_of(impact);
    const double slides_from = math::atan(friction * std::max(3.5, 3.5 * (1 + e) - 1 / (e * 0.8)));
    Finding finding;
    finding.theory = kGain;
    finding.measured = 0;
    for (double degrees = 0; degrees < 90; degrees += degrees < 84 ? 3 : 0.5) {
        const double angle = degrees * pi / 180, ratio = energy_ratio(impact, plan, angle);
        finding.curve.push_back(
            {degrees, ratio, angle > slides_from ? sliding_energy(e, friction, angle) : kUnknown});
        finding.measured = std::max(finding.measured, ratio);
    }
    return finding;
}

// A ball flies into the edge of two planes at a right angle and meets the second plane within a contact
// time before or after the first. Gives the largest energy ratio of all directions and delays.
double corner_ratio(const Plan& plan, double from_normal, double around) {
    const double step = plan.clock.step, time = plan.wall[0].contact_time, speed = 0.3;
    const Vec3 velocity = -speed * Vec3(math::sin(from_normal) * math::cos(around),
                                        math::sin(from_normal) * math::sin(around), math::cos(from_normal));
    double largest = 0;
    for (double delay = -1; delay <= 1; delay += 0.25) {
        SmallWorld world(plan, 0.2 * bench_radius);
        world.add_plane(Vec3::Zero(), Vec3(0, 0, 1));
        world.add_plane(Vec3(-bench_radius * (1 + 1e-9) + velocity.x() * delay * time, 0, 0), Vec3(1, 0, 0));
        world.add(Vec3(std::max(0.0, velocity.x() * delay * time), 0, bench_radius) - 0.3 * step * velocity,
                  velocity);
        world.start();
        const double before = world.kinetic();
        world.run(static_cast<std::int64_t>(6 * time / step));
        largest = std::max(largest, world.kinetic() / before);
    }
    return largest;
}

Finding grazing_in_a_corner(double e, bool quick) {
    const Plan plan = plan_of(on_wall(e, 0.5));
    Finding finding;
    finding.theory = kGain;
    finding.measured = 0;
    for (double degrees = 0; degrees < 90; degrees += 4) {
        double largest = 0;
        for (double around = 0; around <= 90; around += quick ? 22.5 : 7.5)
            largest = std::max(largest, corner_ratio(plan, degrees * pi / 180, around * pi / 180));
        finding.curve.push_back({degrees, largest, kGain});
        finding.measured = std::max(finding.measured, largest);
    }
    return finding;
}

}  // namespace

std::vector<Experiment> friction_experiments() {
    const auto silent = Failing::silent;
    const std::string guard = "energy watch at 5 % of the turnover", energy = "largest energy after / before";
    return {
        {"friction 0 to 1e6", energy, silent, guard, gain_by_friction},
        {"sticking at friction 1e6", "slip after / before", silent, "none needed", sticking},
        {"grazing at a wall (e = 0.9)", energy, silent, guard, [](bool) { return grazing_at_a_wall(0.9); }},
        {"grazing at a wall (e = 1)", energy, silent, guard, [](bool) { return grazing_at_a_wall(1); }},
        {"grazing in a corner (e = 0.9)", energy, silent, guard,
         [](bool quick) { return grazing_in_a_corner(0.9, quick); }},
        {"grazing in a corner (e = 1)", energy, silent, guard,
         [](bool quick) { return grazing_in_a_corner(1, quick); }}};
}

// The tangential force of a contact that is moved along a given path: it turns as a whole, goes round a
// closed loop of normal and tangential motion, or goes through cycles that end where they began.

namespace {

using std::numbers::pi;

constexpr double kModulus = 2e8;  // Pa, of Hertz
constexpr double kFriction = 0.5, kGammaOfSlip = 1.0 / 3;

PairPlan contact_of(TangentialLaw tangential, double mu) {
    const bool hertz = tangential == TangentialLaw::mindlin;
    PairPlan pair = latching_pair(bench_stiffness, 1, mu);
    pair.model = {hertz ? NormalForce::hertz : NormalForce::walton_braun, tangential};
    pair.gamma = kGammaOfSlip;
    pair.modulus = kModulus;
    return pair;
}

// ---- turning and twisting ----

// Change of the tangential force T of a loaded contact that turns as one body, in n steps a turn, about an
// axis through the contact.
struct Turned {
    double length_change = 0, direction_error = 0;  // divided by |T|; rad
};
Turned turn_round(const Vec3& axis, int steps, int turns) {
    DrivenContact contact(contact_of(TangentialLaw::incremental_slip, kFriction));
    const Vec3 up(0, 0, 1);
    constexpr double overlap = 1e-3 * bench_radius;
    for (int k = 0; k < 50; ++k) contact.move({up, overlap, Vec3(2e-3 * overlap, 0, 0), 0});
    const Vec3 before = contact.tangential();
    const double angle = 2 * pi / steps;
    Turned result;
    for (int k = 1; k <= steps * turns; ++k) {
        const auto normal_at = [&](double when) { return Vec3(rotation_about(axis, angle * when) * up); };
        contact.move({normal_at(k), overlap, Vec3::Zero(), angle * axis.dot(normal_at(k - 0.5))});
        result.length_change =
            std::max(result.length_change, std::abs(contact.tangential().norm() / before.norm() - 1));
    }
    const Vec3 after = contact.tangential();
    result.direction_error = math::atan2(before.cross(after).norm(), before.dot(after));
    return result;
}

Finding turning_length(bool) {
    Finding finding;
    const Vec3 axis = Vec3(1, 2, -0.5).normalized();
    constexpr int turns = 20;
    for (const int steps : {12, 24, 50, 100, 200, 500, 1000}) {
        finding.measured = turn_round(axis, steps, turns).length_change;
        finding.theory = std::numeric_limits<double>::epsilon() * steps * turns;  // one rounding in each step
        finding.curve.push_back({static_cast<double>(steps), finding.measured, finding.theory});
    }
    return finding;
}

// In each step Cayley's rotation lags behind by angle^3 / 12.
Finding twisting_direction(bool) {
    Finding finding;
    for (const int steps : {12, 24, 50, 100, 200, 500, 1000}) {
        const double lag = math::cube(2 * pi) / (12.0 * steps * steps);
        const double error = turn_round(Vec3(0, 0, 1), steps, 1).direction_error;
        finding.curve.push_back({static_cast<double>(steps), error, lag});
        if (steps != 100) continue;
        finding.theory = lag;
        finding.measured = error;
    }
    return finding;
}

// ---- closed loops ----

// Energy that a contact makes in a closed loop, divided by the work of the slip forwards. The contact slips
// forwards at the overlap `high` and by as much backwards at `low`, and is elastic along the normal (Elata &
// Berryman 1996, Mech. Mater. 24, 229).
double made_in_a_loop(TangentialLaw law, double low, double high) {
    constexpr int steps = 4000;
    DrivenContact contact(contact_of(law, kFriction));
    double overlap = 0, put_in = 0, forwards = 0;
    const auto lead = [&](double to, double slip) {
        const double rise = (to - overlap) / steps;
        double work = 0;
        for (int k = 0; k < steps; ++k) {
            const double normal = contact.normal_force(), tangential = contact.tangential().x();
            overlap += rise;
            contact.move({Vec3(0, 0, 1), overlap, Vec3(slip / steps, 0, 0), 0});
            work += 0.5 * (normal + contact.normal_force()) * rise +
                    0.5 * (tangential + contact.tangential().x()) * slip / steps;
        }
        put_in += work;
        return work;
    };
    const double slip = 0.2 * kFriction * std::min(low, high);  // well below Coulomb's limit
    lead(low, 0);
    put_in = 0;
    lead(high, 0);
    forwards = lead(high, slip);
    lead(low, 0);
    lead(low, -slip);
    return -put_in / forwards;
}

// Walton's loading curve T(s) = L [1 - (1 - (1 - gamma) K0 s / L)^(1 / (1 - gamma))]: its integral from 0
// to s, and its value at s.
struct LoadingCurve {
    double work, force;
};
LoadingCurve loading_curve(double limit, double slip) {
    const double power = 1 / (1 - kGammaOfSlip), x = 0.8 * bench_stiffness * slip / limit;
    const double rest = 1 - (1 - kGammaOfSlip) * x;
    const double integral = x - (1 - math::pow(rest, power + 1)) / ((power + 1) * (1 - kGammaOfSlip));
    return {limit * limit / (0.8 * bench_stiffness) * integral, limit * (1 - math::pow(rest, power))};
}

double made_by_theory(TangentialLaw law, double low, double high) {
    if (law == TangentialLaw::linear_spring) return 0;
    // The force shrinks with the stiffness while the contact shrinks, and stays constant while it grows.
    if (law == TangentialLaw::mindlin) {
        const double ratio = std::sqrt(low / high);  // ratio of the stiffnesses
        return low < high ? ratio - 1 : 1 - ratio;
    }
    const double slip = 0.2 * kFriction * std::min(low, high);
    const LoadingCurve there = loading_curve(kFriction * bench_stiffness * high, slip);
    const LoadingCurve back = loading_curve(kFriction * bench_stiffness * low + there.force, slip);
    return (there.force * slip - back.work) / there.work - 1;
}

Experiment loop_of(TangentialLaw law, const std::string& name, const std::string& guard) {
    return {"closed loop of " + name, "largest energy made / work of the slip", Failing::silent, guard,
            [law](bool) {
                constexpr double overlap = 1e-3 * bench_radius;
                Finding finding;
                finding.theory = finding.measured = -1;
                for (const double ratio : logarithmic(0.1, 10, 25)) {
                    const CurvePoint point{ratio, made_in_a_loop(law, overlap, ratio * overlap),
                                           made_by_theory(law, overlap, ratio * overlap)};
                    finding.curve.push_back(point);
                    finding.theory = std::max(finding.theory, point.theory);
                    finding.measured = std::max(finding.measured, point.value);
                }
                return finding;
            }};
}

// ---- ratcheting ----

// The slip that the tangential spring still has after a cycle, divided by d0 p. Two touching grains go
// through cycles that end where they began: the overlap is d = d0 (1 + cos(psi) / 2) while they turn by
// p sin(psi), either as one body (`swing`) or each in its place (roll). With arms of the full radius, a turn
// by dp gives d dp too much slip when the grains swing; with arms to the contact plane, when they roll. In a
// cycle this adds up to pi/2 (derived; on the consequences see McNamara, Garcia-Rojo & Herrmann 2008, Phys.
// Rev. E 77, 031304).
double slip_a_cycle(LeverArms arms, bool swing, int steps) {
    constexpr double depth = 1e-3 * bench_radius, swings = 0.1;
    constexpr int cycles = 10;
    SmallWorld world(contact_of(TangentialLaw::linear_spring, 1e9), 1e-5);
    world.plan.arms = arms;
    const SmallWorld::Sphere immovable{bench_radius, 1e18 * bench_density};
    const auto place = [&](int k) {
        const double psi = 2 * pi * k / steps, angle = swing ? swings * math::sin(psi) : 0;
        const double apart = 2 * bench_radius - depth * (1 + 0.5 * math::cos(psi));
        return Vec3(apart * math::cos(angle), apart * math::sin(angle), 0);
    };
    world.add(Vec3::Zero(), Vec3::Zero(), immovable);
    world.add(place(0), Vec3::Zero(), immovable);
    world.start();
    for (int k = 0; k < cycles * steps; ++k) {
        const double turn = swings * (math::sin(2 * pi * (k + 1) / steps) - math::sin(2 * pi * k / steps));
        world.velocity(1) = (place(k + 1) - world.position(1)) / world.plan.clock.step;
        for (Motion& m : world.grains.motion) m.spin = Vec3(0, 0, turn / world.plan.clock.step);
        world.run(1);
    }
    double sheared = 0;
    world.loop->visit_contacts(
        world.step, [&](const ContactView& c) { sheared = c.tangential.norm() / (0.8 * bench_stiffness); });
    return sheared / cycles / (depth * swings);
}

Experiment ratchet(LeverArms arms, bool swing) {
    const bool plane = arms == LeverArms::contact_plane;
    const double theory = plane == swing ? 0 : pi / 2;
    return {std::string(swing ? "ratcheting of a swinging pair " : "ratcheting of a rolling pair ") +
                (plane ? "(arms to the plane)" : "(arms of the radius)"),
            "slip a cycle / (overlap x angle)", Failing::silent,
            plane ? "the default" : "check warns of arms = radius", [=](bool) {
                Finding finding;
                finding.theory = theory;
                for (const int steps : {16, 32, 64, 128, 256}) {
                    finding.measured = slip_a_cycle(arms, swing, steps);
                    finding.curve.push_back({static_cast<double>(steps), finding.measured, theory});
                }
                return finding;
            }};
}

}  // namespace

std::vector<Experiment> path_experiments() {
    const std::string guard = "energy watch at 5 % of the turnover";
    std::vector<Experiment> all = {
        {"turning pair", "change of |T| / |T| in 20 turns", Failing::silent, "none needed", turning_length},
        {"twisting pair", "direction error of T in rad a turn of 100 steps", Failing::silent, "none needed",
         twisting_direction},
        loop_of(TangentialLaw::linear_spring, "linear-spring", guard),
        loop_of(TangentialLaw::mindlin, "mindlin", guard),
        loop_of(TangentialLaw::incremental_slip, "incremental-slip", guard)};
    for (const LeverArms arms : {LeverArms::contact_plane, LeverArms::radius})
        for (const bool swing : {true, false}) all.push_back(ratchet(arms, swing));
    return all;
}

}  // namespace grainreel
