// The numbers of each kind of contact, as the plan has them.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/handover/carry.hpp"
#include "engine/plan/damping.hpp"
#include "engine/plan/plan_parts.hpp"

namespace grainreel {

namespace {

CarriedLaw law_of(const CarryRequest& request, const PairPlan& plan) {
    switch (plan.model.normal) {
        case NormalForce::spring_dashpot:
            return CarriedLaw::spring_dashpot;
        case NormalForce::hertz:
            return CarriedLaw::hertz;
        case NormalForce::walton_braun_speed:
            return CarriedLaw::luding;
        default:
            return request.edinburgh ? CarriedLaw::edinburgh : CarriedLaw::spring_dashpot;
    }
}

// `all` are the sizes that may meet.
CarriedPair pair_of(CarriedLaw law, const PairPlan& plan, const std::vector<Touching>& all) {
    const Touching& mean = all[all.size() / 2];
    CarriedPair pair;
    pair.law = law;
    pair.effective_mass = mean.effective_mass;
    pair.effective_radius = mean.effective_radius;
    pair.stiffness = plan.loading_stiffness;
    pair.unloading = plan.unloading_stiffness;
    pair.hardening = plan.hardening;
    pair.tangential = plan.tangential_stiffness;
    pair.restitution = pair.lowest = pair.highest = plan.restitution;
    pair.friction =
        plan.model.tangential == TangentialLaw::none ? 0 : std::min(plan.friction, kEndlessFriction);
    pair.rolling = plan.model.rolls ? plan.rolling_friction : 0;
    pair.attraction = plan.attraction;
    if (law == CarriedLaw::hertz) {
        pair.stiffness = 4.0 / 3.0 * plan.modulus;
        pair.tangential = 2 * plan.tangential_ratio * plan.modulus;  // 8 G*: ratio = 4 G* / E*
        pair.damping = plan.hertz_damping;
        pair.tangential_damping = std::sqrt(plan.tangential_ratio);  // over the normal one
    } else if (law == CarriedLaw::spring_dashpot) {
        pair.damping = plan.damping_rate(mean.effective_mass);
        pair.tangential_damping = plan.tangential_damping_rate(mean.effective_mass);
        pair.restitution = plan.restitution_of(mean.effective_mass, 1);
        pair.lowest = 1, pair.highest = 0;
        for (const Touching& sizes : all) {
            const double natural = std::sqrt(plan.loading_stiffness / sizes.effective_mass);
            const double e = linear_restitution(pair.damping / (2 * natural), plan.attraction);
            pair.lowest = std::min(pair.lowest, e);
            pair.highest = std::max(pair.highest, e);
        }
    }
    if (plan.model.tangential == TangentialLaw::none) pair.tangential = pair.tangential_damping = 0;
    return pair;
}

void add_types(CarriedScene& carried) {
    const auto add = [&](const Species& one, const std::string& name, bool glued) {
        carried.types.push_back(
            {name, one.diameter.mean, one.diameter.smallest, one.diameter.largest, one.density, glued});
    };
    for (const Species& one : carried.scene.species) add(one, one.name, false);
    if (!carried.plan.glued.empty())
        add(carried.scene.species[carried.scene.container.wall_grains->species], "glued", true);
}

// One damping for all sizes of two species: what that makes of the restitution.
void say_spread(CarriedScene& carried) {
    double lowest = 1, highest = 0, wanted = 0;
    std::string who;
    for (std::size_t a = 0; a < carried.type_count(); ++a)
        for (std::size_t b = a; b < carried.type_count(); ++b) {
            const CarriedPair& pair = carried.between(a, b);
            if (pair.highest - pair.lowest <= highest - lowest) continue;
            lowest = pair.lowest, highest = pair.highest, wanted = pair.restitution;
            who = carried.types[a].name + " and " + carried.types[b].name;
        }
    if (highest - lowest < 1e-6) return;
    add_change(carried, carried.scene.where("contact.restitution"),
               fmt::format("the restitution of {} lies between {:.3f} and {:.3f} in place of {:.3f}", who,
                           lowest, highest, wanted),
               "damping is one number a pair of types there, and their sizes are spread");
}

void check_hertz(CarriedScene& carried, const CarriedPair& pair) {
    if (carried.engine != PeerEngine::lammps || pair.law != CarriedLaw::hertz) return;
    if (tsuji_restitution(pair.damping)) return;
    const std::string where = carried.scene.where("contact.restitution");
    for (const CarryNote& note : carried.refusals)
        if (note.where == where) return;
    add_refusal(carried, where,
                fmt::format("a restitution of {} with hertz is lower than LAMMPS' damping formula goes",
                            pair.restitution));
}

}  // namespace

void carry_contacts(const CarryRequest& request, CarriedScene& carried) {
    const Scene& scene = carried.scene;
    const Plan& plan = carried.plan;
    const std::size_t count = scene.species.size();
    add_types(carried);
    const std::size_t types = carried.types.size();
    const auto table = [&](const PairPlan& numbers, std::size_t a, const Species* b) {
        const CarriedPair pair = pair_of(law_of(request, numbers), numbers, extremes(scene.species[a], b));
        check_hertz(carried, pair);
        return pair;
    };
    carried.pairs.assign(types * types, {});
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b)
            carried.pairs[a * types + b] = table(plan.between(a, b), a, &scene.species[b]);
        if (types == count) continue;
        Species glued = scene.species[scene.container.wall_grains->species];
        glued.density = std::numeric_limits<double>::infinity();
        carried.pairs[a * types + count] = carried.pairs[count * types + a] = table(plan.glued[a], a, &glued);
    }
    // Two glued grains and a glued grain and a wall never touch. They take numbers that are there.
    const auto never = [](CarriedPair pair) {
        pair.touches = false;
        return pair;
    };
    if (types > count) carried.pairs.back() = never(carried.pairs.front());
    CarriedSurface walls{"walls", {}};
    for (std::size_t a = 0; a < count; ++a) walls.with.push_back(table(plan.wall[a], a, nullptr));
    if (types > count) walls.with.push_back(never(walls.with.front()));
    carried.surfaces.push_back(walls);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        CarriedSurface mesh{scene.meshes[m].name, {}};
        for (std::size_t a = 0; a < count; ++a) mesh.with.push_back(table(plan.at_mesh(m, a), a, nullptr));
        if (types > count) mesh.with.push_back(never(mesh.with.front()));
        carried.surfaces.push_back(mesh);
    }
    say_spread(carried);
}

}  // namespace grainreel
