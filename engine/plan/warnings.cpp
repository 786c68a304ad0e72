// Warnings of what will run, but perhaps not as one wishes. They tell before the run what would go wrong in
// it without stopping it.
#include "engine/plan/warnings.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {

namespace {

constexpr double alarming_size_ratio = 10;
constexpr double rounding = 1e-9;  // relative; a decimal number exactly at a bound is not beyond it

double smallest_free_diameter(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species)
        if (species.all() > 0) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

// Whether only the drive sets grains in motion: none flow out, come, or fly at the start.
bool only_the_drive_moves(const Scene& scene) {
    return !scene.container.outlet && scene.feeds.empty() && scene.start.method != Start::Method::grains;
}

// Whether a stage that begins at once takes the drive's place. The change to a stage lets its amplitude grow,
// without drive.ramp.
bool is_replaced(const Drive& drive) {
    return drive.changes() && drive.stages.front().from <= 0;
}

// Whether no energy is lost, neither between grains nor at walls: then what the drive puts in stays.
bool nothing_is_lost(const Scene& scene, const Plan& plan) {
    const std::vector<ContactKind> kinds = contact_kinds(scene, plan);
    return !kinds.empty() && std::all_of(kinds.begin(), kinds.end(), [](const ContactKind& kind) {
        return kind.pair->restitution == 1 && kind.pair->friction == 0;
    });
}

void warn_of_drive(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings) {
    const Drive& drive = scene.drive;
    if (!drive.present) return;
    const bool upright = drive.direction.x() == 0 && drive.direction.y() == 0;
    if (upright && bed.gravity > 0 && bed.g_level < 1 - rounding && only_the_drive_moves(scene))
        warnings.add(
            "drive",
            fmt::format("g_level is {:.3g}, below 1: the bed stays on the floor and nothing will move; raise "
                        "g_level or amplitude",
                        bed.g_level));
    const bool reaches_a_period =
        drive.frequency * scene.run.duration >= 1;  // if not, likely_slips() warns of it
    if (reaches_a_period && !is_replaced(drive) && drive.ramp / drive.frequency > scene.run.duration)
        warnings.add("drive.ramp",
                     fmt::format("the drive grows over {:.4g} s, longer than the run of {:.4g} s, and never "
                                 "reaches its amplitude; lengthen the run or shorten the ramp",
                                 drive.ramp / drive.frequency, scene.run.duration));
    if (nothing_is_lost(scene, plan))
        warnings.add("contact",
                     "restitution 1 loses no energy, so the drive heats the grains without limit; lower it");
}

// A quick change from one frequency to another shakes harder than either of them.
void warn_of_changes(const Scene& scene, Warnings& warnings) {
    constexpr double alarming = 1.2;  // times the larger of the two accelerations
    const Drive& drive = scene.drive;
    if (!drive.present || !drive.changes()) return;
    const DriveSchedule schedule(drive);
    for (std::size_t i = 0; i < schedule.pieces().size(); ++i) {
        const DriveSchedule::Piece& piece = schedule.pieces()[i];
        const double larger = std::max(piece.acceleration_before, piece.acceleration);
        const double peak = peak_acceleration_of_change(schedule, piece.stage);
        if (!schedule.times().stretches()[i].changes() || peak <= alarming * larger) continue;
        warnings.add(
            fmt::format("drive.stage[{}].over", piece.stage - 1),
            fmt::format("the change to this stage shakes with up to {:.3g} m/s2, {:.3g} times as hard "
                        "as what is before or after it; raise 'over'",
                        peak, peak / larger));
    }
}

// A sine that starts at once has its top speed at once, unless its phase says otherwise.
void warn_of_kick(const Scene& scene, Warnings& warnings) {
    const Drive& drive = scene.drive;
    if (!drive.present || drive.ramp > 0 || is_replaced(drive) || scene.start.keep_clock) return;
    if (scene.start.method == Start::Method::grains) return;  // no grain need lie on what moves
    const double kick = drive.speed() * std::abs(math::cos(2 * std::numbers::pi * drive.phase));
    if (kick > 0.05 * drive.speed())
        warnings.add(
            "drive.ramp",
            fmt::format("without a ramp the drive starts at {:.3g} m/s and kicks the bed; take a ramp "
                        "of 3 periods, or a phase of 90 deg",
                        kick));
}

void warn_of_arms(const Plan& plan, Warnings& warnings) {
    if (plan.arms == LeverArms::radius)
        warnings.add(
            "contact.arms",
            "the radius as lever arm does not keep angular momentum, and the slip of pairs that swing "
            "to and fro adds up (ratcheting); leave it out, unless it is what you study");
}

void warn_of_step(const Scene& scene, const Plan& plan, const BedPlan& bed, const StepChoice& step,
                  Warnings& warnings) {
    const double smallest = smallest_free_diameter(scene), largest = largest_diameter(scene);
    const double travelled = std::max(bed.impact_speed, bed.drop_speed) * plan.clock.step;
    if (travelled > 0.1 * smallest / 2)
        warnings.add(
            "run.step",
            fmt::format("a grain may cross {:.2g} of the smallest radius in one step; shorten the step",
                        travelled / (smallest / 2)));
    if (largest > alarming_size_ratio * smallest * (1 + rounding))
        warnings.add(
            "species",
            fmt::format("the largest grain is {:.3g} times the smallest: the step follows the small and "
                        "the search for neighbours the big, so this will be slow",
                        largest / smallest));
    if (plan.clock.step > step.stable)
        warnings.add(
            "run.step",
            fmt::format("{:.4g} s is above the stable limit of {:.4g} s: the run will blow up; shorten "
                        "the step or leave it out",
                        plan.clock.step, step.stable));
    if (plan.integrator == Integrator::forest_ruth && plan.rubs())
        warnings.add("run.integrator",
                     "drifts backwards at times, which friction takes for a turn of the slip: tangential "
                     "velocities are off by several per cent at any step; take velocity-verlet");
}

// The species whose grains have most contacts, and the one with the largest grains; they may be the same.
struct Sizes {
    const Species *usual, *largest;
    bool one() const { return usual == largest; }
};
Sizes sizes_of(const Scene& scene) {
    const std::vector<double> shares = contact_shares(scene);
    const auto usual = std::max_element(shares.begin(), shares.end()) - shares.begin();
    Sizes sizes{&scene.species[usual], &scene.species[usual]};
    for (const Species& species : scene.species)
        if (species.all() > 0 && species.diameter.largest > sizes.largest->diameter.largest)
            sizes.largest = &species;
    return sizes;
}

void warn_of_outlet(const Scene& scene, Warnings& warnings) {
    constexpr double kFewest = 5;  // grains side by side, below which they arch (Zuriguel 2014)
    if (!scene.container.outlet) return;
    const double wide = 2 * scene.container.outlet->half_width;
    const Sizes sizes = sizes_of(scene);
    const auto narrow = [&](const Species& s) {
        return wide < kFewest * s.diameter.largest * (1 - rounding);
    };
    if (narrow(*sizes.usual))
        warnings.add("container.outlet",
                     fmt::format("the outlet is {:.2g} grains wide, and one narrower than {} may clog; widen "
                                 "it unless you mean to see that",
                                 wide / sizes.usual->diameter.largest, kFewest));
    else if (narrow(*sizes.largest))
        warnings.add("container.outlet",
                     fmt::format("the outlet is {:.2g} grains of \"{}\" wide, and these may clog one that is "
                                 "narrower than {}; widen it unless you mean to see that",
                                 wide / sizes.largest->diameter.largest, sizes.largest->name, kFewest));
}

void warn_of_short_period(const Scene& scene, Warnings& warnings) {
    constexpr double kWide = 6;  // diameters; a bed of a longer period hardly feels its images
    const Container& c = scene.container;
    if (!c.periodic_depth) return;
    const Sizes sizes = sizes_of(scene);
    const auto is_short = [&](const Species& s) {
        return c.depth < kWide * s.diameter.largest * (1 - rounding);
    };
    if (is_short(*sizes.usual))
        warnings.add(
            "container.depth",
            fmt::format("the period is {:.3g} diameters of the grains, and below {} grains meet the "
                        "images of their own neighbours, which orders the bed; lengthen it unless you "
                        "mean that",
                        c.depth / sizes.usual->diameter.largest, kWide));
    else if (is_short(*sizes.largest))
        warnings.add(
            "container.depth",
            fmt::format(
                "the period is {:.3g} diameters of \"{}\", and below {} one of these meets neighbours "
                "of its own image; lengthen it unless you mean that",
                c.depth / sizes.largest->diameter.largest, sizes.largest->name, kWide));
}

}  // namespace

std::vector<std::string> plan_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed,
                                       const StepChoice& step) {
    Warnings warnings(scene);
    warn_of_drive(scene, plan, bed, warnings);
    warn_of_changes(scene, warnings);
    warn_of_kick(scene, warnings);
    warn_of_contacts(scene, plan, bed, warnings);
    warn_of_arms(plan, warnings);
    warn_of_step(scene, plan, bed, step, warnings);
    warn_of_few_steps(scene, plan, warnings);
    warn_of_outlet(scene, warnings);
    warn_of_short_period(scene, warnings);
    return warnings.take();
}

}  // namespace grainreel
