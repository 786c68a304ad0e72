// What contacts as they are planned will do to a bed. What is said of it is said of most of its contacts; a
// few that are beyond a bound are named.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr double alarming_overlap =
    0.05;  // over the smaller diameter; 1 % is the usual aim for most contacts
// docs/reference/stability.md has what each of these costs.
constexpr double alarming_turn = 0.05;      // of a period that a contact with a moving wall lasts
constexpr double alarming_flight = 0.2;     // of a diameter that a grain flies while a contact lasts
constexpr double fewest_last_places = 100;  // of a position, in the overlap of a grain at rest

using Kinds = std::vector<ContactKind>;

// The mean of a number of each kind, over all contacts of grains, or over those at walls.
template <class Of>
double mean_over(const Kinds& kinds, bool at_wall, const Of& of) {
    double sum = 0, shares = 0;
    for (const ContactKind& kind : kinds) {
        if (kind.at_wall != at_wall) continue;
        sum += kind.share * of(kind);
        shares += kind.share;
    }
    return shares > 0 ? sum / shares : 0;
}

// " (0.1 s in most contacts, 0.2 s between "nut" and a wall)", where a few last much longer than the rest.
std::string longest_text(const Kinds& kinds, bool at_wall, double mean) {
    constexpr double much = 1.25;
    const ContactKind* longest = nullptr;
    for (const ContactKind& kind : kinds)
        if (kind.at_wall == at_wall && (!longest || kind.mean_contact_time() > longest->mean_contact_time()))
            longest = &kind;
    if (!longest || longest->mean_contact_time() < much * mean) return "";
    return fmt::format(" ({:.2g} s in most contacts, {:.2g} s between {})", mean,
                       longest->mean_contact_time(), longest->name);
}

void warn_of_overlaps(const Plan& plan, Warnings& warnings) {
    if (plan.usual_overlap > alarming_overlap)
        warnings.add("contact.stiffness",
                     fmt::format("overlaps of {:.2g} of a diameter are expected in most contacts, more than "
                                 "{:.2g}, and up to {:.2g} between {}; raise the stiffness",
                                 plan.usual_overlap, alarming_overlap, plan.expected_overlap, plan.deepest));
    else if (plan.expected_overlap > alarming_overlap)
        warnings.add("contact.stiffness",
                     fmt::format("overlaps of up to {:.2g} of a diameter are expected between {}, more than "
                                 "{:.2g}, where most contacts have {:.2g}; raise the stiffness of that pair",
                                 plan.expected_overlap, plan.deepest, alarming_overlap, plan.usual_overlap));
}

// m/s, from which on grains of a kind pass through each other, in their slowest combination of sizes.
double tunnelling_speed(const ContactKind& kind) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const Touching& t : extremes(kind.first, kind.other()))
        slowest = std::min(slowest, t.distance * std::sqrt(kind.pair->loading_stiffness / t.effective_mass));
    return slowest;
}

void warn_of_tunnelling(const BedPlan& bed, const Kinds& kinds, Warnings& warnings) {
    const double fastest = std::max(bed.impact_speed, bed.drop_speed);
    const ContactKind* softest = nullptr;
    for (const ContactKind& kind : kinds)
        if (!softest || tunnelling_speed(kind) < tunnelling_speed(*softest)) softest = &kind;
    if (!softest || fastest <= 0.5 * tunnelling_speed(*softest)) return;
    warnings.add(
        "contact.stiffness",
        fmt::format("grains at {:.3g} m/s may pass through each other, which happens from {:.3g} m/s "
                    "on between {}; raise the stiffness",
                    fastest, tunnelling_speed(*softest), softest->name));
}

void warn_of_softness(const BedPlan& bed, const Kinds& kinds, Warnings& warnings) {
    const double lasts = mean_over(kinds, false, [](const auto& kind) { return kind.mean_contact_time(); });
    const double share = bed.frequency * bed.layers * lasts;
    if (bed.gravity == 0 || share <= 0.2) return;
    warnings.add(
        "contact.stiffness",
        fmt::format(
            "a wave needs {:.2g} of a period to cross the bed, which then behaves like a soft body{}; "
            "raise the stiffness",
            share, longest_text(kinds, false, lasts)));
}

// Contacts that last too long for what else happens meanwhile.
void warn_of_long_contacts(const BedPlan& bed, const Kinds& kinds, Warnings& warnings) {
    const double at_walls = mean_over(kinds, true, [](const auto& kind) { return kind.mean_contact_time(); });
    if (bed.frequency * at_walls > alarming_turn)
        warnings.add(
            "contact.stiffness",
            fmt::format(
                "a contact lasts {:.2g} of a period, in which what is shaken changes its speed by {:.2g} "
                "of the largest, so that rebounds are off{}; raise the stiffness",
                bed.frequency * at_walls, 2 * std::numbers::pi * bed.frequency * at_walls,
                longest_text(kinds, true, at_walls)));
    const double flight = mean_over(kinds, false, [&](const ContactKind& kind) {
        return bed.impact_speed * kind.mean_contact_time() / kind.smaller_diameter();
    });
    if (flight > alarming_flight)
        warnings.add("contact.stiffness",
                     fmt::format("a grain may fly {:.2g} of a diameter while a contact lasts, so that grains "
                                 "close together lose too little energy (detachment); raise the stiffness",
                                 flight));
}

// m: how far a grain of its weight sinks into another, or into a wall.
double resting_overlap(const PairPlan& pair, const Species& species, bool into_wall, double gravity) {
    const double diameter = species.diameter.smallest;
    const double weight = mass_of(species, diameter) * gravity;
    if (pair.modulus == 0) return weight / pair.loading_stiffness;
    const double k = 4.0 / 3 * pair.modulus * std::sqrt(into_wall ? diameter / 2 : diameter / 4);
    return std::pow(weight / k, 2.0 / 3);
}

void warn_of_rounding(const Scene& scene, const BedPlan& bed, const Kinds& kinds, Warnings& warnings) {
    if (bed.gravity == 0) return;
    const Extent extent = extent_of(scene);
    const double farthest = std::max(extent.low.cwiseAbs().maxCoeff(), extent.high.cwiseAbs().maxCoeff());
    const double last_place = std::numeric_limits<double>::epsilon() * farthest;
    for (const ContactKind& kind : kinds) {
        const bool alike = kind.second && kind.second->name == kind.first.name;
        if (kind.at_wall ? kind.second.has_value() : !alike) continue;
        const double overlap = resting_overlap(*kind.pair, kind.first, kind.at_wall, bed.gravity);
        if (overlap > fewest_last_places * last_place) continue;
        warnings.add("contact.stiffness",
                     fmt::format("at rest a grain of \"{}\" sinks in by {:.2g} m only, {:.2g} times the "
                                 "rounding of its position, and the force is noise; lower the stiffness",
                                 kind.first.name, overlap, overlap / last_place));
        return;
    }
}

}  // namespace

void warn_of_contacts(const Scene& scene, const Plan& plan, const BedPlan& bed, Warnings& warnings) {
    const Kinds kinds = contact_kinds(scene, plan);
    warn_of_overlaps(plan, warnings);
    warn_of_tunnelling(bed, kinds, warnings);
    warn_of_softness(bed, kinds, warnings);
    warn_of_long_contacts(bed, kinds, warnings);
    warn_of_rounding(scene, bed, kinds, warnings);
}

void warn_of_few_steps(const Scene& scene, const Plan& plan, Warnings& warnings) {
    if (!scene.run.step && !scene.run.steps_per_contact) return;
    for (const ContactKind& kind : contact_kinds(scene, plan)) {
        const PairPlan& pair = *kind.pair;
        const int wanted = steps_per_contact(pair.model.normal, pair.restitution, scene.run.accuracy);
        const double actual = pair.contact_time / plan.clock.step;
        if (actual > wanted * (1 - 1e-9)) continue;
        warnings.add(scene.run.step ? "run.step" : "run.steps_per_contact",
                     fmt::format("a contact between {} lasts {:.3g} steps where {} are wanted, so that "
                                 "restitution {:.3g} will not be kept; shorten the step or leave it out",
                                 kind.name, actual, wanted, pair.restitution));
        return;
    }
}

}  // namespace grainreel
