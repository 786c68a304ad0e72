// What will run, but perhaps not as one wishes. Failures that cannot stop a run are said before it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/plan/plan_parts.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive/drive_schedule.hpp"

namespace grainreel {
namespace {

constexpr double alarming_overlap =
    0.05;  // over the smaller diameter; 1 % is the usual aim for most contacts
constexpr double alarming_size_ratio = 10;
// docs/reference/stability.md has what each of these costs.
constexpr double alarming_turn = 0.05;      // of a period that a contact with a moving wall lasts
constexpr double alarming_flight = 0.2;     // of a diameter that a grain flies while a contact lasts
constexpr double fewest_last_places = 100;  // of a position, in the overlap of a grain at rest

void warn_of_drive(const Scene& scene, const BedPlan& bed, Warnings& warnings) {
    const Drive& drive = scene.drive;
    if (!drive.present) return;
    const bool upright = drive.direction.x() == 0 && drive.direction.y() == 0;
    if (upright && bed.gravity > 0 && bed.g_level < 1)
        warnings.add(
            "drive",
            fmt::format("gamma is {:.3g}, below 1: the bed stays on the floor and nothing will move; raise "
                        "g_level or amplitude",
                        bed.g_level));
    const bool reaches_a_period =
        drive.frequency * scene.run.duration >= 1;  // else likely_slips() has said it
    if (reaches_a_period && drive.ramp / drive.frequency > scene.run.duration)
        warnings.add("drive.ramp",
                     fmt::format("the drive grows over {:.4g} s, longer than the run of {:.4g} s, and never "
                                 "reaches its amplitude; lengthen the run or shorten the ramp",
                                 drive.ramp / drive.frequency, scene.run.duration));
    const bool elastic =
        std::any_of(scene.contact.grain.begin(), scene.contact.grain.end(),
                    [](const PairContact& pair) { return pair.restitution == 1 && !pair.normal_damping; });
    if (elastic)
        warnings.add("contact",
                     "restitution 1 loses no energy, so the drive heats the grains without limit; lower it");
}

// A quick change from one frequency to another shakes harder than either of them.
void warn_of_changes(const Scene& scene, Warnings& warnings) {
    constexpr double alarming = 1.2;  // over the larger of the two accelerations
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

void warn_of_softness(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings) {
    if (plan.expected_overlap > alarming_overlap)
        warnings.add(
            "contact.stiffness",
            fmt::format(
                "overlaps of {:.2g} of a diameter are expected, more than {:.2g}; raise the stiffness",
                plan.expected_overlap, alarming_overlap));
    double slowest = 0, tunnelling = std::numeric_limits<double>::infinity();
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b <= count; ++b) {
            const PairPlan& pair = b < count ? plan.between(a, b) : plan.wall[a];
            slowest = std::max(slowest, pair.contact_time);
            for (const Touching& t : extremes(scene.species[a], b < count ? &scene.species[b] : nullptr))
                tunnelling =
                    std::min(tunnelling, t.distance * std::sqrt(pair.loading_stiffness / t.effective_mass));
        }
    }
    const double fastest = std::max(bed.impact_speed, bed.drop_speed);
    if (fastest > 0.5 * tunnelling)
        warnings.add(
            "contact.stiffness",
            fmt::format(
                "grains at {:.3g} m/s may pass through each other, which happens from {:.3g} m/s on; raise "
                "the stiffness",
                fastest, tunnelling));
    if (bed.gravity > 0 && bed.frequency * bed.layers * slowest > 0.2)
        warnings.add(
            "contact.stiffness",
            fmt::format(
                "a wave needs {:.2g} of a period to cross the bed, which then behaves like a soft body; "
                "raise the stiffness",
                bed.frequency * bed.layers * slowest));
}

// A sine that starts at once has its top speed at once, unless its phase says otherwise.
void warn_of_kick(const Scene& scene, Warnings& warnings) {
    const Drive& drive = scene.drive;
    if (!drive.present || drive.ramp > 0 || scene.start.keep_clock) return;
    if (scene.start.method == Start::Method::grains) return;  // nothing need lie on what moves
    const double kick = drive.speed() * std::abs(std::cos(2 * std::numbers::pi * drive.phase));
    if (kick > 0.05 * drive.speed())
        warnings.add(
            "drive.ramp",
            fmt::format("without a ramp the drive starts at {:.3g} m/s and kicks the bed; take a ramp "
                        "of 3 periods, or a phase of 90 deg",
                        kick));
}

// Contacts that last too long for what else happens meanwhile.
void warn_of_long_contacts(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings) {
    double at_walls = 0, flight = 0;
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        at_walls = std::max(at_walls, plan.wall[a].contact_time);
        for (std::size_t b = a; b < count; ++b) {
            const double smaller =
                std::min(scene.species[a].diameter.smallest, scene.species[b].diameter.smallest);
            flight = std::max(flight, bed.impact_speed * plan.between(a, b).contact_time / smaller);
        }
    }
    if (bed.frequency * at_walls > alarming_turn)
        warnings.add(
            "contact.stiffness",
            fmt::format(
                "a contact lasts {:.2g} of a period, in which what is shaken changes its speed by {:.2g} "
                "of the largest, so that rebounds are off; raise the stiffness",
                bed.frequency * at_walls, 2 * std::numbers::pi * bed.frequency * at_walls));
    if (flight > alarming_flight)
        warnings.add("contact.stiffness",
                     fmt::format("a grain may fly {:.2g} of a diameter while a contact lasts, so that grains "
                                 "close together lose too little energy (detachment); raise the stiffness",
                                 flight));
}

// m: how far a grain of its weight sinks into another.
double resting_overlap(const PairPlan& pair, const Species& species, double gravity) {
    const double diameter = species.diameter.smallest;
    const double weight = species.density * std::numbers::pi / 6 * std::pow(diameter, 3) * gravity;
    if (pair.modulus == 0) return weight / pair.loading_stiffness;
    const double k = 4.0 / 3 * pair.modulus * std::sqrt(diameter / 4);
    return std::pow(weight / k, 2.0 / 3);
}

void warn_of_rounding(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings) {
    if (bed.gravity == 0) return;
    const Extent extent = extent_of(scene);
    const double farthest = std::max(extent.low.cwiseAbs().maxCoeff(), extent.high.cwiseAbs().maxCoeff());
    const double last_place = std::numeric_limits<double>::epsilon() * farthest;
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        const double overlap = resting_overlap(plan.between(a, a), scene.species[a], bed.gravity);
        if (overlap > fewest_last_places * last_place) continue;
        warnings.add(
            "contact.stiffness",
            fmt::format("at rest a grain of \"{}\" sinks in by {:.2g} m only, {:.2g} times the rounding "
                        "of its position, and the force is noise; lower the stiffness",
                        scene.species[a].name, overlap, overlap / last_place));
        return;
    }
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
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& s : scene.species) smallest = std::min(smallest, s.diameter.smallest);
    const double largest = largest_diameter(scene);
    const double travelled = std::max(bed.impact_speed, bed.drop_speed) * plan.clock.step;
    if (travelled > 0.1 * smallest / 2)
        warnings.add(
            "run.step",
            fmt::format("a grain may cross {:.2g} of the smallest radius in one step; shorten the step",
                        travelled / (smallest / 2)));
    if (largest > alarming_size_ratio * smallest)
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
    if (!scene.run.step && !scene.run.steps_per_contact) return;
    for (const std::vector<PairPlan>* pairs : {&plan.grain, &plan.wall, &plan.glued}) {
        for (const PairPlan& pair : *pairs) {
            const int wanted = steps_per_contact(pair.model.normal, pair.restitution, scene.run.accuracy);
            const double actual = pair.contact_time / plan.clock.step;
            if (actual > wanted * (1 - 1e-9)) continue;
            warnings.add(
                scene.run.step ? "run.step" : "run.steps_per_contact",
                fmt::format(
                    "a contact lasts {:.3g} steps where {} are wanted, so that restitution {:.3g} will not "
                    "be kept; shorten the step or leave it out",
                    actual, wanted, pair.restitution));
            return;
        }
    }
}

// A default colour repeats another species' when the palette has none left.
void warn_of_colours(const Scene& scene, Warnings& warnings) {
    const std::vector<Species>& species = scene.species;
    for (std::size_t i = 0; i < species.size(); ++i) {
        if (scene.written.count(fmt::format("species[{}].colour", i)) > 0) continue;
        for (std::size_t j = 0; j < species.size(); ++j) {
            if (i == j || species[j].colour != species[i].colour) continue;
            warnings.add(fmt::format("species[{}]", i),
                         fmt::format("\"{}\" and \"{}\" look alike: there are more species than default "
                                     "colours; give one a colour of its own, such as colour = \"#8b4513\"",
                                     species[std::min(i, j)].name, species[std::max(i, j)].name));
            return;
        }
    }
}

void warn_of_outlet(const Scene& scene, Warnings& warnings) {
    constexpr double kFewest = 5;  // grains side by side, below which they arch (Zuriguel 2014)
    if (!scene.container.outlet) return;
    double largest = 0;
    for (const Species& species : scene.species) largest = std::max(largest, species.diameter.largest);
    const double wide = 2 * scene.container.outlet->half_width;
    if (wide >= kFewest * largest) return;
    warnings.add("container.outlet",
                 fmt::format("the outlet is {:.2g} grains wide, and one narrower than {} may clog; widen it "
                             "unless you mean to see that",
                             wide / largest, kFewest));
}

void warn_of_short_period(const Scene& scene, Warnings& warnings) {
    constexpr double kWide = 6;  // diameters, above which a bed hardly knows its images
    const Container& c = scene.container;
    if (!c.periodic_depth) return;
    const double largest = largest_diameter(scene);
    if (c.depth >= kWide * largest) return;
    warnings.add(
        "container.depth",
        fmt::format("the period is {:.3g} diameters of the largest grain, and below {} grains meet the "
                    "images of their own neighbours, which orders the bed; lengthen it unless you "
                    "mean that",
                    c.depth / largest, kWide));
}

void warn_of_film(const Scene& scene, Warnings& warnings) {
    double shown = 0;
    for (const FilmSegment& segment : scene.film.segments) {
        if (!segment.duration) return;
        shown += *segment.duration;
    }
    if (!scene.film.segments.empty() && shown < scene.run.duration * (1 - 1e-6))
        warnings.add(
            "film.segment",
            fmt::format("the film shows the first {:.4g} s of {:.4g} s; leave out one duration to show "
                        "the rest",
                        shown, scene.run.duration));
}

}  // namespace

std::vector<std::string> plan_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed,
                                       const StepChoice& step) {
    Warnings warnings(scene);
    warn_of_drive(scene, bed, warnings);
    warn_of_changes(scene, warnings);
    warn_of_softness(scene, plan, bed, warnings);
    warn_of_kick(scene, warnings);
    warn_of_long_contacts(scene, plan, bed, warnings);
    warn_of_rounding(scene, plan, bed, warnings);
    warn_of_arms(plan, warnings);
    warn_of_step(scene, plan, bed, step, warnings);
    warn_of_colours(scene, warnings);
    warn_of_outlet(scene, warnings);
    warn_of_short_period(scene, warnings);
    warn_of_film(scene, warnings);
    return warnings.take();
}

}  // namespace grainreel
