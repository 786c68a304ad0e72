#include "engine/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan_bed.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/plan/reach.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr double most_steps = 9e15;  // a double counts up to so many steps exactly
constexpr double most_records =
    1e9;  // records in one file: so many rows of measures take 400 GB; NetCDF can number about twice as many
constexpr double frames_without_drive = 1.0 / 30, rows_without_drive = 0.01;  // s

// The stiffness that a kind of contact takes from the start file where the scene gives none.
std::optional<double> stiffness_in_file(const StartFacts& file, const PairContact& contact,
                                        const std::vector<std::optional<double>>& kinds, std::size_t kind) {
    if (contact.stiffness || !file.known) return std::nullopt;
    if (kind < kinds.size() && kinds[kind]) return kinds[kind];
    const double found = contact.normal == NormalLaw::hertz ? file.modulus : file.linear;
    return found > 0 ? std::optional(found) : std::nullopt;
}

// Whether the plan's own stiffness must be taken in place of the file's. Contacts that latch (those that
// unload along a steeper line than they load) can rest at many overlaps, so the overlaps in the file give
// only a lower bound.
bool wants_more(const PairPlan& own, const PairPlan& found) {
    const bool latches = own.model.normal != NormalForce::hertz &&
                         own.model.normal != NormalForce::spring_dashpot && own.hardening == 0 &&
                         own.restitution_table.empty();
    return latches && own.loading_stiffness > found.loading_stiffness;
}

PairPlan plan_kind(const Scene& scene, const BedPlan& bed, const StartFacts& file, const PairContact& contact,
                   const Species& a, const Species* b, const std::vector<std::optional<double>>& kinds,
                   std::size_t kind) {
    const std::optional<double> found = stiffness_in_file(file, contact, kinds, kind);
    if (!found) return plan_pair(scene, bed, contact, a, b);
    PairContact with = contact;
    with.stiffness = found;
    PairPlan pair = plan_pair(scene, bed, with, a, b);
    const bool of_run = kind < kinds.size() && kinds[kind];
    pair.stiffness_reason = of_run ? "the start file" : "overlaps in the start file";
    if (of_run || bed.gravity == 0) return pair;
    PairPlan own = plan_pair(scene, bed, contact, a, b);
    return wants_more(own, pair) ? own : pair;
}

// Plans the contacts with glued grains. A glued grain counts as infinitely heavy, like its wall. The numbers
// are those of the pair of species except for the stiffness: it is chosen for the effective mass of the
// contact, which is the free grain's mass (for equal grains twice that of a free pair) and may demand more.
void plan_glued(const Scene& scene, const BedPlan& bed, const StartFacts& file, Plan& plan) {
    if (!scene.container.wall_grains) return;
    const Species glued = glued_species(scene);
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        const Species& first = scene.species[a];
        plan.glued.push_back(
            plan_kind(scene, bed, file, glued_contact(scene, a), first, &glued, file.glued, a));
    }
}

void plan_contacts(const Scene& scene, const BedPlan& bed, const StartFacts& file, Plan& plan) {
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        const Species& first = scene.species[a];
        for (std::size_t b = 0; b < count; ++b) {
            plan.grain.push_back(b < a ? plan.grain[b * count + a]
                                       : plan_kind(scene, bed, file, scene.between(a, b), first,
                                                   &scene.species[b], file.grain, a * count + b));
        }
        plan.wall.push_back(plan_kind(scene, bed, file, scene.contact.wall[a], first, nullptr, file.wall, a));
    }
    plan_glued(scene, bed, file, plan);
    GRAINREEL_CHECK(scene.contact.mesh.size() == scene.meshes.size() * count);
    for (std::size_t kind = 0; kind < scene.contact.mesh.size(); ++kind)
        plan.mesh.push_back(plan_kind(scene, bed, file, scene.contact.mesh[kind], scene.species[kind % count],
                                      nullptr, file.mesh, kind));
}

// Finds the largest overlap of all kinds of contact, and the usual one: the mean over contacts between
// grains, or over those at walls if that is larger.
void plan_overlaps(const Scene& scene, const BedPlan& bed, Plan& plan) {
    double between_grains = 0, at_walls = 0;
    std::string heaviest;  // the species whose grains land on others the hardest
    for (const Species& species : scene.species)
        if (species.all() > 0 && mass_of(species, species.diameter.largest) >= bed.largest_mass)
            heaviest = species.name;
    for (const ContactKind& kind : contact_kinds(scene, plan)) {
        const Species* other = kind.other();
        const double largest =
            expected_overlap(scene, bed, *kind.pair, extremes(kind.first, other), bed.largest_mass);
        if (largest > plan.expected_overlap) {
            plan.expected_overlap = largest;
            const bool under = kind.first.name != heaviest && (!other || other->name != heaviest);
            plan.deepest = kind.name + (under ? fmt::format(" under \"{}\"", heaviest) : "");
        }
        const double usual =
            expected_overlap(scene, bed, *kind.pair, {mean_touching(kind.first, other)}, bed.usual_mass);
        (kind.at_wall ? at_walls : between_grains) += kind.share * usual;
    }
    plan.usual_overlap = std::max(between_grains, at_walls);
}

// Gives `seconds` in steps. key: the scene's key that the error names if there are too many.
std::int64_t count_steps(const Scene& scene, double seconds, double step, const char* key) {
    const double steps = seconds / step;
    if (steps > most_steps)
        throw UserError(
            "{}: {:.4g} s in steps of {:.4g} s make {:.3g} steps, and the most are {:.2g}; "
            "shorten it or lengthen run.step",
            scene.where(key), seconds, step, steps, most_steps);
    return std::llround(steps);
}

// Rounds the step down so that a multiple of 8 makes one period. Then eighths, quarters and halves of a
// period fall on steps.
Clock plan_clock(const Scene& scene, double step) {
    Clock clock;
    clock.step = step;
    if (!scene.drive.present) return clock;
    // A step that has been rounded this way before must come back unchanged, so there is a small tolerance.
    double eighths = std::max(1.0, std::ceil(1 / (8 * scene.drive.frequency * step) * (1 - 1e-12)));
    if (scene.drive.changes()) eighths = common_eighths(scene.drive, eighths);
    const std::int64_t period = count_steps(scene, 8 * eighths, 1, "drive.frequency");
    return drive_clock(scene.drive, 1 / (scene.drive.frequency * static_cast<double>(period)), period);
}

// Throws if a file would hold too many records, with one every `every` steps.
void check_records(const Scene& scene, const Plan& plan, double every, const char* what, const char* key) {
    const double records = static_cast<double>(plan.steps) / every;
    if (records <= most_records) return;
    throw UserError(
        "{}: the run's {} steps make {:.4g} {}, and the most are {:.2g}; lengthen '{}' or shorten "
        "'run.duration'",
        scene.where(key), plan.steps, records, what, most_records, key);
}

// Where the scene gives no interval, the time between records is a number of periods of the drive's present
// stage.
void go_by_periods(const Output& output, Plan& plan) {
    const double mean = static_cast<double>(plan.steps) / plan.clock.cycles(plan.steps);  // steps per period
    if (output.trajectory && !output.trajectory_interval) {
        plan.trajectory_periods = 1;
        plan.trajectory_every = mean;
    }
    if (!output.measures_interval) {
        plan.measures_periods = 1.0 / 8;
        plan.measures_every = mean / 8;
    }
}

void plan_output(const Scene& scene, Plan& plan) {
    const Output& output = scene.output;
    const std::int64_t period = plan.clock.steps_per_period;
    const auto every = [&](const std::optional<double>& interval, std::int64_t driven, double without,
                           const char* key) {
        if (!interval && period > 0) return static_cast<double>(driven);
        const double seconds = interval.value_or(without), steps = seconds / plan.clock.step;
        const auto whole = static_cast<double>(count_steps(scene, seconds, plan.clock.step, key));
        return std::max(1.0, std::abs(steps - whole) < 1e-9 * whole ? whole : steps);
    };
    if (output.trajectory)
        plan.trajectory_every =
            every(output.trajectory_interval, period, frames_without_drive, "output.trajectory_interval");
    plan.measures_every =
        every(output.measures_interval, period / 8, rows_without_drive, "output.measures_interval");
    if (scene.drive.changes()) go_by_periods(output, plan);
    if (output.trajectory)
        check_records(scene, plan, plan.trajectory_every, "frames of the trajectory",
                      "output.trajectory_interval");
    check_records(scene, plan, plan.measures_every, "rows of measures", "output.measures_interval");
    check_field_size(scene);
    plan.fields = field_times(output.fields, plan.clock, plan.steps);
}

void plan_outlet(const Scene& scene, Plan& plan) {
    if (!scene.container.outlet) return;
    const double opens = scene.container.outlet->opens;
    plan.opens = count_steps(scene, opens, plan.clock.step, "container.outlet.opens");
    plan.traffic = !scene.container.tray;
    if (*plan.opens >= plan.steps)
        throw UserError(
            "{}: the outlet opens at {:.4g} s, but the run ends at {:.4g} s; open it "
            "earlier or lengthen run.duration",
            scene.where("container.outlet.opens"), opens, scene.run.duration);
}

// This is checked here and not by the reader of scenes, because a finished run can be drawn again after its
// start file is gone.
void check_start_file(const Scene& scene) {
    const std::string& file = scene.start.file;
    if (scene.start.method != Start::Method::file || is_plain(file)) return;
    const bool exists = is_there(file);
    throw UserError("{}: 'file' names {}, which {}; give a checkpoint or final.csv",
                    scene.where("start.file"), file, exists ? "is no file" : "does not exist");
}

// The step (s) that the plan would choose if only the drive moved walls. Compared with it, one sees whether a
// wall's own speed makes the step far too short: nobody means such a fast rim, and the run would never end.
// If no wall moves by itself, the given step is returned.
double step_without_own_speeds(const Scene& scene, const StartFacts& file, const BedPlan& bed, double step) {
    if (bed.speed_of_others == bed.impact_speed || bed.speed_of_others == 0) return step;
    BedPlan slow = bed;
    slow.impact_speed = bed.speed_of_others;
    Plan plan;
    plan.integrator = scene.run.integrator;
    plan_contacts(scene, slow, file, plan);
    return std::max(step, plan_step(scene, plan).step);
}

bool any_contact(const Plan& plan, bool (*is)(const PairPlan&)) {
    const auto any = [&](const std::vector<PairPlan>& pairs) {
        return std::any_of(pairs.begin(), pairs.end(), is);
    };
    return any(plan.grain) || any(plan.wall) || any(plan.glued) || any(plan.mesh);
}
}  // namespace

bool Plan::rubs() const {
    return any_contact(*this, [](const PairPlan& p) { return p.model.tangential != TangentialLaw::none; });
}

bool Plan::rolls() const {
    return any_contact(*this, [](const PairPlan& p) { return p.model.rolls; });
}

Plan make_plan(const Scene& scene, const StartFacts& file) {
    check_start_file(scene);
    Plan plan;
    plan.arms = scene.contact.arms;
    plan.integrator = scene.run.integrator;
    plan.wall_speed = fastest_own_speed(scene);
    plan.moving_walls = (scene.drive.present && scene.drive.largest_amplitude() > 0) ||
                        std::any_of(scene.walls.begin(), scene.walls.end(),
                                    [](const ScenePlane& wall) { return !wall.velocity.isZero(0); }) ||
                        plan.wall_speed > 0;
    plan.capacity = scene.grains();

    const BedPlan bed = plan_bed(scene, file);
    plan.bed_height = bed.height;
    plan.impact_speed = bed.impact_speed;
    plan_contacts(scene, bed, file, plan);
    plan_overlaps(scene, bed, plan);

    const StepChoice step = plan_step(scene, plan);
    check_rims(scene, step_without_own_speeds(scene, file, bed, step.step));
    plan.step_reason = step.reason;
    plan.clock = plan_clock(scene, step.step);
    plan.steps = count_steps(scene, scene.run.duration, plan.clock.step, "run.duration");
    if (plan.steps == 0)
        throw UserError("{}: 'duration' of {:.4g} s is shorter than half a step of {:.4g} s; lengthen it",
                        scene.where("run.duration"), scene.run.duration, plan.clock.step);
    plan_outlet(scene, plan);
    plan.traffic = plan.traffic || !scene.feeds.empty() || !scene.exits.empty();
    if (scene.start.packs())
        plan.settle_steps_limit =
            count_steps(scene, scene.start.settle_limit, plan.clock.step, "start.settle_limit");
    if (scene.start.method == Start::Method::rain)
        plan.rain_steps_limit = count_steps(scene, rain_limit(scene), plan.clock.step, "start.rain_rate");
    plan_output(scene, plan);
    plan.warnings = scene.notes;
    for (const std::vector<std::string>& found : {likely_slips(scene), plan_warnings(scene, plan, bed, step),
                                                  start_warnings(scene, plan, bed), exit_warnings(scene)})
        plan.warnings.insert(plan.warnings.end(), found.begin(), found.end());
    return plan;
}

}  // namespace grainreel
