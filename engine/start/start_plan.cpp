// The plan of a scene that starts from a file: what follows from the file, and what happens to its bed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"
#include "engine/start/bed_in_file.hpp"
#include "engine/start/held_histories.hpp"
#include "engine/start/mesh_checks.hpp"
#include "engine/start/settle.hpp"

namespace grainreel {

namespace {

std::optional<double> stiffness_there(const PairContact& here, const PairContact& there,
                                      const PairPlan& plan) {
    if (here.normal != there.normal) return std::nullopt;
    return here.normal == NormalLaw::hertz ? plan.modulus : plan.loading_stiffness;
}

// Takes the stiffness of contacts with meshes from meshes of the same name in the file's run.
void take_mesh_stiffness(const Scene& scene, const StartOrigin& origin, StartFacts& facts) {
    const std::size_t count = scene.species.size();
    facts.mesh.resize(scene.contact.mesh.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh* same = origin.scene.mesh_named(scene.meshes[m].name);
        if (same == nullptr) continue;
        const auto there = static_cast<std::size_t>(same - origin.scene.meshes.data());
        for (std::size_t a = 0; a < count; ++a)
            facts.mesh[m * count + a] =
                stiffness_there(scene.contact.mesh[m * count + a],
                                origin.scene.contact.mesh[there * count + a], origin.plan.at_mesh(there, a));
    }
}

// Takes the stiffness that the file's run had, where its law is this scene's.
void take_stiffness(const Scene& scene, const StartOrigin& origin, StartFacts& facts) {
    const std::size_t count = scene.species.size();
    if (origin.scene.species.size() != count) return;
    const auto of = stiffness_there;
    for (std::size_t k = 0; k < count * count; ++k)
        facts.grain.push_back(
            of(scene.contact.grain[k], origin.scene.contact.grain[k], origin.plan.grain[k]));
    for (std::size_t a = 0; a < count; ++a)
        facts.wall.push_back(of(scene.contact.wall[a], origin.scene.contact.wall[a], origin.plan.wall[a]));
    take_mesh_stiffness(scene, origin, facts);
    if (!scene.container.wall_grains || origin.plan.glued.empty()) return;
    const std::size_t glued = scene.container.wall_grains->species;
    for (std::size_t a = 0; a < count; ++a)
        facts.glued.push_back(of(scene.between(a, glued),
                                 origin.scene.between(a, origin.scene.container.wall_grains->species),
                                 origin.plan.glued[a]));
}

bool is_at_rest(const BedInFile& bed) {
    return bed.moves_because.empty();
}

// The speed of impacts to expect: at least that of the run the file comes from, if it is known. Otherwise a
// bed at rest may fall by one diameter, and a bed that moves falls to its lowest grain.
double expected_speed(const Scene& scene, const BedInFile& bed) {
    if (bed.origin) return std::max(bed.origin->plan.impact_speed, bed.fastest);
    if (!is_at_rest(bed)) return bed.falls;
    return math::hypot(bed.fastest, std::sqrt(2 * scene.gravity.norm() * mean_diameter(scene)));
}

StartFacts facts_of(const Scene& scene, const BedInFile& bed) {
    StartFacts facts;
    facts.known = true;
    if (bed.origin) take_stiffness(scene, *bed.origin, facts);
    if (is_at_rest(bed)) stiffness_of_overlaps(scene, bed, facts);
    facts.speed = expected_speed(scene, bed);
    return facts;
}

StartFacts facts_to_go_on(const Scene& scene) {
    StartFacts facts;
    const std::optional<StartOrigin> origin = origin_of(scene.start.file);
    if (!origin) return facts;
    facts.known = true;
    take_stiffness(scene, *origin, facts);
    facts.speed = origin->plan.impact_speed;
    return facts;
}

std::string stiffness_text(const Plan& plan) {
    bool file = false, overlaps = false, scene = false, own = false;
    for (const std::vector<PairPlan>* kinds : {&plan.grain, &plan.wall, &plan.glued, &plan.mesh}) {
        for (const PairPlan& pair : *kinds) {
            const std::string& reason = pair.stiffness_reason;
            bool& which = reason == "the start file"               ? file
                          : reason == "overlaps in the start file" ? overlaps
                          : reason == "the scene"                  ? scene
                                                                   : own;
            which = true;
        }
    }
    std::vector<std::string> from;
    if (scene) from.push_back("as the scene gives it");
    if (file) from.push_back("as in the file's run");
    if (overlaps) from.push_back("from the overlaps in the file");
    if (own) from.push_back("as impacts and weight want it");
    return fmt::format("stiffness {}", fmt::join(from, ", or "));
}

std::string text_of(const Plan& plan, const BedInFile& bed, bool all_kept) {
    std::string text = stiffness_text(plan) + "; ";
    if (all_kept)
        text += "contacts keep their histories";
    else if (plan.start.keeps_histories)
        text += "contacts whose law is the file's keep their histories, the others begin anew";
    else if (bed.of_checkpoint)
        text += "contacts begin anew, for their law is not that of the file's run";
    else
        text += "contacts begin anew, for a table has no histories";
    if (plan.start.relaxes) return text + "; the bed rests in the file and is brought to rest before time 0";
    if (all_kept && is_at_rest(bed)) return text;
    return text + fmt::format("; nothing is damped, for {}", bed.moves_because);
}

void plan_start(const BedInFile& bed, Plan& plan) {
    const bool held = bed.of_checkpoint && bed.origin;
    const bool all_kept = held && all_act_alike(plan, bed.origin->plan);
    plan.start.keeps_histories = held && any_act_alike(plan, bed.origin->plan);
    plan.start.relaxes = !all_kept && is_at_rest(bed);
    if (plan.start.relaxes) plan.settle_steps_limit = std::llround(std::ceil(kRelaxLimit / plan.clock.step));
    plan.start.text = text_of(plan, bed, all_kept);
}

void warn_of_exits(const Scene& scene, const Grains& grains, Plan& plan) {
    const auto leaves = [&](const Place& place) {
        return std::any_of(scene.exits.begin(), scene.exits.end(),
                           [&](const ExitBox& exit) { return exit.holds(place.position); });
    };
    const auto leave = std::count_if(grains.place.begin(), grains.place.end(), leaves);
    if (leave > 0)
        plan.warnings.push_back(
            exit_warning(scene, static_cast<double>(leave), std::ssize(grains.place), true));
}

// The plan by the kind of start; meshes are not checked.
Plan plan_of(const Scene& scene) {
    if (scene.start.method != Start::Method::file) return make_plan(scene, StartFacts());
    if (scene.start.keep_clock) {
        Plan plan = make_plan(scene, facts_to_go_on(scene));
        plan.start.text = "goes on at its step";
        return plan;
    }
    std::optional<BedInFile> bed;
    try {
        bed = bed_in_file(scene);
    } catch (const UserError&) {
        // The error is left to the reader of the grains. A run that goes on from its own checkpoint needs
        // no such file.
    }
    if (!bed) return make_plan(scene, StartFacts());
    Plan plan = make_plan(scene, facts_of(scene, *bed));
    plan_start(*bed, plan);
    warn_of_exits(scene, bed->grains, plan);
    return plan;
}

}  // namespace

Plan make_plan(const Scene& scene) {
    Plan plan = plan_of(scene);
    if (!scene.start.keep_clock) check_meshes(scene, plan);
    return plan;
}

}  // namespace grainreel
