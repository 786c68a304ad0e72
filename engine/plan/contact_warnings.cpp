// Warnings of what the planned contacts will do to a bed. A message is about most contacts; a few that are
// beyond a bound are named.
#include "engine/plan/warnings.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/contact_kinds.hpp"
#include "engine/plan/plan_parts.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

constexpr double alarming_overlap =
    0.05;  // as a share of the smaller diameter; 1 % is the usual aim for most contacts
// docs/reference/stability.md tells what contacts beyond the next two bounds cost.
constexpr double alarming_turn = 0.05;   // periods that a contact with a moving wall lasts
constexpr double alarming_flight = 0.2;  // diameters that a grain flies while a contact lasts
constexpr double fewest_last_places =
    100;  // how many times the rounding of a position the overlap of a grain at rest must be

using Kinds = std::vector<ContactKind>;

// The mean of one number of each kind, over all contacts between grains, or over those at walls.
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

// " (0.1 s in most contacts, 0.2 s between "nut" and a wall)" if one kind lasts much longer than the mean;
// else empty.
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

// The lowest speed (m/s), among all sizes, at which the grains of a kind of contact pass through each other.
double tunnelling_speed(const ContactKind& kind) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const PairSizes& t : extremes(kind.first, kind.other()))
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

// Warns of contacts that last too long compared with a period of the drive or with a grain's flight.
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

// How far (m) a grain sinks by its weight into another, or into a wall.
double resting_overlap(const PairPlan& pair, const Species& species, bool into_wall, double gravity) {
    const double diameter = species.diameter.smallest;
    const double weight = mass_of(species, diameter) * gravity;
    if (pair.modulus == 0) return weight / pair.loading_stiffness;
    const double k = 4.0 / 3 * pair.modulus * std::sqrt(into_wall ? diameter / 2 : diameter / 4);
    return math::pow(weight / k, 2.0 / 3);
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

// Seams between facets of a wall: the largest sin^2 of a turn, and how many edges turn so far.
struct Seams {
    double squared_sine = 0;
    std::int64_t count = 0;
};
Seams seams_of(const std::vector<double>& squared_sines) {
    constexpr double kAlike = 0.8;
    Seams seams;
    for (const double one : squared_sines) seams.squared_sine = std::max(seams.squared_sine, one);
    seams.count = std::count_if(squared_sines.begin(), squared_sines.end(),
                                [&](double one) { return one > kAlike * seams.squared_sine; });
    return seams;
}

// Seams of a round wall, and of one that is meant to be round, but turns too far at each seam to be one wall.
struct RoundWalls {
    Seams smooth, coarse;
};
RoundWalls round_walls_of(const Surface& surface) {
    constexpr double kFewestFacets = 12;  // around a wall that is meant to be round
    const double coarse_cosine = math::cos(2.001 * std::numbers::pi / kFewestFacets);
    std::vector<double> smooth, coarse;
    for (std::int32_t t = 0; t < surface.size(); ++t)
        for (int edge = 0; edge < 3; ++edge) {
            const Neighbour& next = surface.neighbour(t, edge);
            if (next.triangle <= t || next.turn == Neighbour::Turn::flat) continue;
            const Vec3 &here = surface.normal(t), there = surface.normal(next.triangle);
            const bool is_smooth = next.turn == Neighbour::Turn::smooth;
            if (!is_smooth && (next.flips ? -1 : 1) * here.dot(there) < coarse_cosine) continue;
            (is_smooth ? smooth : coarse).push_back(here.cross(there).squaredNorm());
        }
    return {seams_of(smooth), seams_of(coarse)};
}

// A grain that slides over a seam of a round wall meets the next facet with the sine of the turn as its
// normal velocity.
void warn_of_facets(const Scene& scene, const Plan& plan, Warnings& warnings) {
    constexpr double kAlarming = 0.005;
    constexpr std::int64_t kFew = 12;  // an edge that is rounded off
    const std::size_t species = scene.species.size();
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface.of || plan.mesh.size() < (m + 1) * species) continue;
        double e = 1;
        for (std::size_t s = 0; s < species; ++s) e = std::min(e, plan.mesh[m * species + s].restitution);
        const auto alarms = [&](const Seams& seams) {
            return (1 - e * e) * seams.squared_sine > kAlarming && seams.count >= kFew;
        };
        const RoundWalls walls = round_walls_of(*mesh.surface.of);
        const bool is_coarse = alarms(walls.coarse);
        const Seams& seams = is_coarse ? walls.coarse : walls.smooth;
        if (!alarms(seams)) continue;
        warnings.add(
            fmt::format("mesh[{}].file", m),
            fmt::format("facets of \"{}\" turn by {:.2g} degrees from one to the next, {}and a grain that "
                        "slides across a seam loses (1 - e^2) sin^2 of that, {:.2g} % of its energy of "
                        "motion; take more facets: twice as many lose a quarter at each",
                        mesh.name, math::asin(std::sqrt(seams.squared_sine)) * 180 / std::numbers::pi,
                        is_coarse ? "too far to be one wall (36 around are), " : "",
                        100 * (1 - e * e) * seams.squared_sine));
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
    warn_of_facets(scene, plan, warnings);
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
