#include "engine/run/health.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

constexpr double kTurnoverShare = 0.05;

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
           grains.spin[i].rate.allFinite();
}

}  // namespace

HealthLimits health_limits(const Scene& scene, const Plan& plan) {
    HealthLimits limits;
    limits.clock = plan.clock;
    for (const Species& s : scene.species) limits.species.push_back(s.name);
    return limits;
}

void check_state(const HealthLimits& limits, const Surroundings& around, const Grains& grains,
                 const StepLoop& loop, std::int64_t step) {
    const Pose pose = around.motion.at(step);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        if (!finite(grains, i)) {
            throw RunError(fmt::format("{}: {} is no longer a number; take a smaller run.step",
                                       moment(limits.clock, step), grain_name(limits, grains, i)));
        }
        for (const Face& face : around.faces) {
            if (distance_to(face, face.displacement(pose), grains.place[i].position).distance >
                -grains.place[i].radius)
                continue;
            throw RunError(
                fmt::format("{}: {} went through the {}; take a smaller run.step or a larger "
                            "contact.wall.stiffness",
                            moment(limits.clock, step), grain_name(limits, grains, i), face.name));
        }
    }
    loop.visit_contacts(step, [&](const ContactView& c) {
        if (c.overlap <= limits.overlap * c.smaller_radius) return;
        const std::string other = c.second >= 0 ? fmt::format("grain {}", grains.id[c.second])
                                                : "the " + around.faces[-1 - c.second].name;
        throw RunError(
            fmt::format("{}: {} overlaps {} by {:.2f} of the smaller radius; take a larger "
                        "contact.stiffness or a smaller run.step",
                        moment(limits.clock, step), grain_name(limits, grains, c.first), other,
                        c.overlap / c.smaller_radius));
    });
}

void EnergyWatch::check(double energy, double work, double allowance, const Clock& clock, std::int64_t step) {
    const double balance = energy - work;
    if (std::isnan(first_)) first_ = balance;
    work_done_ = std::max(work_done_, std::abs(work));
    lowest_ = std::min(lowest_, balance);
    const double turnover = std::max(first_ - lowest_, work_done_);
    const double risen = balance - lowest_;
    if (risen <= kTurnoverShare * turnover + allowance) return;
    throw RunError(
        fmt::format("{}: the grains gained {:.3g} J that no wall gave them ({:.3g} J turned over so far); "
                    "take a smaller run.step",
                    moment(clock, step), risen, turnover));
}

}  // namespace grainreel
