// A stiffness that a run takes over from the file it starts from may be less than its own drive wants.
#include <fmt/format.h>

#include <algorithm>

#include "engine/plan/plan_parts.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr double alarming_share = 4;  // overlaps are then twice as large as they are wanted

struct Wanted {
    double share = 0;  // over what there is
    double stiffness = 0, there = 0;
    bool hertz = false;
};

bool is_of_file(const PairPlan& pair) {
    return pair.stiffness_reason.ends_with("start file");
}

// What the plan would choose by itself for one kind of contact, where it is more than all before.
void look_at(const Scene& scene, const BedPlan& bed, const PairPlan& pair, const PairContact& contact,
             const Species& a, const Species* b, Wanted& most) {
    if (!is_of_file(pair)) return;
    const bool hertz = contact.normal == NormalLaw::hertz;
    const PairPlan own = plan_pair(scene, bed, contact, a, b);
    const double stiffness = hertz ? own.modulus : own.loading_stiffness;
    const double there = hertz ? pair.modulus : pair.loading_stiffness;
    if (stiffness > most.share * there) most = {stiffness / there, stiffness, there, hertz};
}

}  // namespace

std::vector<std::string> start_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed) {
    Warnings warnings(scene);
    if (bed.gravity == 0 && bed.impact_speed == 0) return {};
    Wanted most;
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b)
            look_at(scene, bed, plan.between(a, b), scene.between(a, b), scene.species[a], &scene.species[b],
                    most);
        look_at(scene, bed, plan.wall[a], scene.contact.wall[a], scene.species[a], nullptr, most);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            look_at(scene, bed, plan.at_mesh(m, a), scene.contact.mesh[m * count + a], scene.species[a],
                    nullptr, most);
    }
    if (most.share > alarming_share) {
        const char *name = most.hertz ? "modulus" : "stiffness", *unit = most.hertz ? "Pa" : "N/m";
        warnings.add(
            "start.file",
            fmt::format("the {0} follows from the file and is {1:.3g} {2}, while impacts of {3:.3g} "
                        "m/s want {4:.3g} {2} for overlaps of {5:.2g} %; write contact.{0} = "
                        "\"{4:.3g} {2}\" to have that",
                        name, most.there, unit, bed.impact_speed, most.stiffness, 100 * scene.run.overlap));
    }
    return warnings.take();
}

}  // namespace grainreel
