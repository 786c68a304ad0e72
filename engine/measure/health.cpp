#include "engine/measure/health.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/measure/energy.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

namespace {

constexpr double kTurnoverShare = 0.05;
// Allowance for rounding, as a share of the largest sum of energies. Rounding adds up to 5e-13 in 26,000
// steps of a free fall.
constexpr double kRounding = 1e-8;
constexpr std::int64_t kStepsPerLook = 200;
constexpr double kFasterMeanwhile =
    2;  // a grain hit by a heavy one may be this many times as fast at the next look

std::string moment(const Clock& clock, std::int64_t step) {
    return fmt::format("step {} ({:.6g} s)", step, clock.time(step));
}

std::string grain_name(const HealthLimits& limits, const Grains& grains, std::size_t i) {
    const Vec3& x = grains.place[i].position;
    return fmt::format("grain {} ({}) at ({:.4g}, {:.4g}, {:.4g}) m", grains.id[i],
                       limits.species[grains.species[i]], x.x(), x.y(), x.z());
}

bool finite(const Grains& grains, std::size_t i) {
    return grains.place[i].position.allFinite() && grains.motion[i].velocity.allFinite() &&
           grains.motion[i].spin.allFinite();
}

double largest_mass(const Species& species) {
    return species.density * std::numbers::pi / 6 * math::cube(species.diameter.largest);
}

// Speed (m/s) of an impact in which two grains, or a grain and a wall, overlap by `depth` (m).
double speed_for(double depth, const PairPlan& pair, double effective_mass) {
    return depth * std::sqrt(pair.loading_stiffness / effective_mass);
}

struct Box {
    Vec3 low, high;
    void take(const Vec3& v) { low = low.cwiseMin(v), high = high.cwiseMax(v); }
    double size() const { return (high - low).norm(); }
};

// The box of all velocities (m/s). No two grains have a larger relative speed than its size.
Box velocities(const Grains& grains) {
    if (grains.size() == 0) return {Vec3(0, 0, 0), Vec3(0, 0, 0)};
    Box box{grains.motion[0].velocity, grains.motion[0].velocity};
    for (const Motion& motion : grains.motion) box.take(motion.velocity);
    return box;
}

std::size_t fastest_of(const Grains& grains) {
    std::size_t fastest = 0;
    for (std::size_t i = 1; i < grains.size(); ++i)
        if (grains.motion[i].velocity.squaredNorm() > grains.motion[fastest].velocity.squaredNorm())
            fastest = i;
    return fastest;
}

// Number of the vessel if it is one closed sheet of triangles, else -1. Grains may leave over the rim of a
// vessel that is open above, or whose walls have a thickness.
std::int32_t closed_vessel(const Scene& scene) {
    const SceneMesh* vessel = scene.vessel();
    if (vessel == nullptr || !vessel->surface->facts().closed()) return -1;
    if (scene.container.room->open_above() || !scene.exits.empty()) return -1;
    return static_cast<std::int32_t>(vessel - scene.meshes.data());
}

}  // namespace

HealthLimits health_limits(const Scene& scene, const Plan& plan) {
    HealthLimits limits;
    limits.clock = plan.clock;
    limits.wall_speed = plan.wall_speed;
    limits.vessel = closed_vessel(scene);
    limits.planned = 2 * std::max(scene.run.overlap, plan.expected_overlap);  // of diameters there
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        const Species& first = scene.species[a];
        const double radius = 0.5 * first.diameter.smallest, mass = largest_mass(first);
        limits.species.push_back(first.name);
        limits.smallest_radius = std::min(limits.smallest_radius, radius);
        const auto take = [&](double smaller, const PairPlan& pair, double effective_mass) {
            limits.safe_speed =
                std::min(limits.safe_speed, speed_for(limits.overlap * smaller, pair, effective_mass));
        };
        take(radius, plan.wall[a], mass);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) take(radius, plan.at_mesh(m, a), mass);
        if (!plan.glued.empty()) {
            const Species& glued = scene.species[scene.container.wall_grains->species];
            take(std::min(radius, 0.5 * glued.diameter.smallest), plan.glued[a], mass);
        }
        for (std::size_t b = 0; b <= a; ++b) {
            const double other = largest_mass(scene.species[b]);
            take(std::min(radius, 0.5 * scene.species[b].diameter.smallest), plan.between(a, b),
                 mass * other / (mass + other));
        }
    }
    return limits;
}

std::int64_t steps_to_next_look(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                                std::int64_t step) {
    const std::int64_t regular = kStepsPerLook - step % kStepsPerLook;
    const DrivePose pose = around.motion.at(step);
    Box box = velocities(grains);
    for (const Face& face : around.faces) box.take(face.velocity_at(pose));
    for (const MeshWall& mesh : around.meshes) box.take(mesh.body.velocity_at(pose));
    const double closing = kFasterMeanwhile * (box.size() + limits.wall_speed);
    if (!(closing > limits.safe_speed)) return regular;
    const double steps = limits.overlap * limits.smallest_radius / (closing * limits.clock.step);
    return std::clamp(static_cast<std::int64_t>(steps), std::int64_t{1}, regular);
}

namespace {

// Checks that no grain moves so far in a step that it could meet another one unseen.
void check_way_of_a_step(const HealthLimits& limits, const Grains& grains, std::int64_t step) {
    const double way = velocities(grains).size() * limits.clock.step;
    if (!(way > limits.smallest_radius)) return;
    throw RunError(
        "{}: grains pass each other by {:.2g} of the smallest radius in one step, {} the "
        "fastest, so that they "
        "may meet unseen; take a smaller run.step",
        moment(limits.clock, step), way / limits.smallest_radius,
        grain_name(limits, grains, fastest_of(grains)));
}

// Checks that grains are in the box around a closed vessel, in the vessel's own frame. This costs almost
// nothing. The step itself notices grains that cross a sheet.
void check_vessel(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                  std::int64_t step) {
    if (limits.vessel < 0) return;
    const MeshWall& vessel = around.meshes[limits.vessel];
    const BodyPose pose = vessel.body.at(around.motion.at(step));
    const MeshFacts& facts = vessel.surface->facts();
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Vec3 place = pose.at_rest(grains.place[i].position);
        if ((place - facts.low).minCoeff() >= 0 && (facts.high - place).minCoeff() >= 0) continue;
        throw RunError(
            "{}: {} went through \"{}\"; take a smaller run.step or a larger stiffness of "
            "its contacts",
            moment(limits.clock, step), grain_name(limits, grains, i), vessel.name);
    }
}

}  // namespace

DeepestContact check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                           const StepLoop& loop, std::int64_t step) {
    return check_state(
        limits, around, grains, [&](const auto& see) { loop.visit_contacts(step, see); }, step);
}

std::string advice_against_press(const std::string& pressing_wall) {
    if (pressing_wall.empty()) return "";
    return fmt::format(
        "{} moves on whatever is in its way: let it stop, or turn back, a grain's diameter before "
        "other walls, or leave fewer grains between",
        pressing_wall);
}

namespace {

// Whether a wall goes its own way, whatever is in its way: it turns, follows a path or has a velocity.
bool goes_its_way(const Body& body) {
    return body.has_own_motion() || !body.velocity.isZero(0);
}

// The name of a wall that goes its own way and presses one of these two grains, which touches something else
// too, against that; empty if none does. A grain that is only hit flies off.
std::string pressing_wall(const Surroundings& around, const ShowContacts& show, std::int32_t first,
                          std::int32_t second) {
    struct Touched {
        std::int32_t contacts = 0, wall = -1;
    };
    std::array<Touched, 2> touched;
    show([&](const ContactView& c) {
        if (c.overlap <= 0) return;
        for (int k = 0; k < 2; ++k) {
            const std::int32_t grain = k == 0 ? first : second;
            if (c.first != grain && c.second != grain) continue;
            ++touched[k].contacts;
            if (c.second >= 0) continue;
            const auto wall = static_cast<std::size_t>(-1 - c.second);
            const std::size_t faces = around.faces.size();
            const Body& body = wall < faces ? around.faces[wall].body : around.meshes[wall - faces].body;
            if (goes_its_way(body)) touched[k].wall = std::max(touched[k].wall, -1 - c.second);
        }
    });
    std::int32_t pressing = -1;
    for (const Touched& one : touched)
        if (one.contacts > 1) pressing = std::max(pressing, one.wall);
    return pressing < 0 ? "" : wall_name(around, pressing);
}

// What may help against the overlap of grain `first` with `second`, which are as in a ContactView.
std::string remedy_for(const Surroundings& around, const ShowContacts& show, std::int32_t first,
                       std::int32_t second) {
    const std::string presses = advice_against_press(pressing_wall(around, show, first, second));
    if (!presses.empty()) return presses;
    const std::int32_t mesh = -1 - second - static_cast<std::int32_t>(around.faces.size());
    const std::string stiffness =
        second >= 0 ? "contact.stiffness"
        : mesh >= 0 ? fmt::format("stiffness of the contacts with {}", wall_name(around, -1 - second))
                    : "contact.wall.stiffness";
    return fmt::format("take a larger {} or a smaller run.step", stiffness);
}

std::size_t index_of_id(const Grains& grains, std::int32_t id) {
    return static_cast<std::size_t>(std::find(grains.id.begin(), grains.id.end(), id) - grains.id.begin());
}

DeepestContact named(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                     const ShowContacts& show, std::int64_t step, const ContactView& c) {
    DeepestContact deepest;
    deepest.share = c.overlap / c.smaller_radius;
    deepest.step = step;
    deepest.time = limits.clock.time(step);
    deepest.grain = grains.id[c.first];
    deepest.species = limits.species[grains.species[c.first]];
    deepest.other =
        c.second < 0 ? wall_name(around, -1 - c.second) : fmt::format("grain {}", grains.id[c.second]);
    if (deepest.share > std::min(limits.told(), limits.overlap))
        deepest.remedy = remedy_for(around, show, c.first, c.second);
    return deepest;
}

}  // namespace

DeepestContact deepest_contact(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                               const ShowContacts& show, std::int64_t step) {
    ContactView deepest{};
    deepest.smaller_radius = 1;
    // Threads show their contacts in another order, so among equals the ids decide.
    const auto ids = [&](const ContactView& c) {
        return std::pair(grains.id[c.first], c.second < 0 ? c.second : grains.id[c.second]);
    };
    show([&](const ContactView& c) {
        const double more = c.overlap * deepest.smaller_radius - deepest.overlap * c.smaller_radius;
        if (more > 0 || (more == 0 && c.overlap > 0 && ids(c) < ids(deepest))) deepest = c;
    });
    if (deepest.overlap <= 0) return {};
    return named(limits, around, grains, show, step, deepest);
}

std::string overlap_text(const HealthLimits& limits, const DeepestContact& deepest) {
    if (deepest.share <= limits.told()) return "";
    return fmt::format(
        "grain {} ({}) overlapped {} by {:.2g} of the smaller radius at {:.6g} s, where {:.2g} are "
        "planned at most; {}",
        deepest.grain, deepest.species, deepest.other, deepest.share, deepest.time, limits.planned,
        deepest.remedy);
}

DeepestContact check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                           const ShowContacts& show, std::int64_t step) {
    const DrivePose pose = around.motion.at(step);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        if (!finite(grains, i)) {
            throw RunError("{}: {} is no longer a number; take a smaller run.step",
                           moment(limits.clock, step), grain_name(limits, grains, i));
        }
        for (const Face& face : around.faces) {
            if (distance_at(face, pose, grains.place[i].position).distance > -grains.place[i].radius)
                continue;
            const auto grain = static_cast<std::int32_t>(i);
            const std::string presses = advice_against_press(pressing_wall(around, show, grain, grain));
            throw RunError(
                "{}: {} went through the {}; {}", moment(limits.clock, step), grain_name(limits, grains, i),
                face.name,
                presses.empty() ? "take a smaller run.step or a larger contact.wall.stiffness" : presses);
        }
    }
    check_vessel(limits, around, grains, step);
    check_way_of_a_step(limits, grains, step);
    DeepestContact deepest = deepest_contact(limits, around, grains, show, step);
    if (deepest.share > limits.overlap)
        throw RunError("{}: {} overlaps {} by {:.2f} of the smaller radius; {}", moment(limits.clock, step),
                       grain_name(limits, grains, index_of_id(grains, deepest.grain)), deepest.other,
                       deepest.share, deepest.remedy);
    return deepest;
}

void EnergyWatch::check(double energy, double work, double through, double allowance,
                        const HealthLimits& limits, const Grains& grains, std::int64_t step) {
    const double balance = energy - work;
    if (std::isnan(balance))
        return;  // the energy of a caller's law is not known; check_state() has made the other checks
    largest_through_ = std::max(largest_through_, through);
    if (std::isnan(first_)) first_ = balance;
    work_done_ = std::max(work_done_, std::abs(work));
    lowest_ = std::min(lowest_, balance);
    const Kinetic kinetic = kinetic_energy(grains);
    const double turnover = std::max(first_ - lowest_, work_done_);
    const double motion = kinetic.translation + kinetic.rotation;
    const double risen = balance - lowest_;
    const double rounding = kRounding * largest_through_;
    if (risen <= kTurnoverShare * (turnover + motion) + allowance + rounding) return;
    throw RunError(energy_gained_text(limits, grains, step, risen,
                                      fmt::format("{:.3g} J turned over so far", turnover)));
}

std::string energy_gained_text(const HealthLimits& limits, const Grains& grains, std::int64_t step,
                               double gained, const std::string& beside) {
    const std::size_t fastest = fastest_of(grains);
    return fmt::format(
        "{}: the grains gained {:.3g} J that no wall gave them ({}), and {} is the fastest at {:.3g} m/s; "
        "take a smaller run.step",
        moment(limits.clock, step), gained, beside, grain_name(limits, grains, fastest),
        grains.motion[fastest].velocity.norm());
}

}  // namespace grainreel
