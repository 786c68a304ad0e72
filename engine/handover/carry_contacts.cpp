// Chooses the contact laws that the other engine gets, and computes the numbers of each kind of contact.
// Formulas of the engines are in their manuals; our own numbers come from the plan.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

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

// all: the pairs of sizes that may meet; the middle one has mean sizes.
CarriedPair pair_of(CarriedLaw law, const PairPlan& plan, const std::vector<PairSizes>& all) {
    const PairSizes& mean = all[all.size() / 2];
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
        pair.tangential_damping = std::sqrt(plan.tangential_ratio);  // a ratio to the normal damping
    } else if (law == CarriedLaw::spring_dashpot) {
        pair.damping = plan.damping_rate(mean.effective_mass);
        pair.tangential_damping = plan.tangential_damping_rate(mean.effective_mass);
        pair.restitution = plan.restitution_of(mean.effective_mass, 1);
        pair.lowest = 1, pair.highest = 0;
        for (const PairSizes& sizes : all) {
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

// The engine has one damping for all sizes of two species. This reports the widest range of restitution that
// results.
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
    // Two glued grains, or a glued grain and a wall, never touch. They get the numbers of other contacts.
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

namespace {

// What happens to the contacts of a scene. Each change is reported once.
struct LawChanges {
    bool latch = false;           // Walton-Braun becomes a spring with a dashpot
    bool slip = false;            // incremental slip becomes a linear spring
    bool fixed_speed = false;     // a restitution by speed becomes one number
    bool shares_modulus = false;  // Hertz in an engine where moduli belong to materials
    bool mixed = false;           // Hertz with a linear tangential spring, or the opposite
    bool table = false;           // a table of restitutions, which neither engine has
    bool luding = false, edinburgh = false;
};

// Whether Walton-Braun stays as it is.
bool keeps_latch(const CarryRequest& request, const PairContact& pair) {
    if (request.engine != PeerEngine::liggghts || !pair.restitution_table.empty()) return false;
    return pair.restitution_speed ? !request.edinburgh : request.edinburgh;
}

void carry_law(const CarryRequest& request, PairContact& pair, LawChanges& changes) {
    if (pair.normal == NormalLaw::hertz) {
        if (request.engine == PeerEngine::liggghts) changes.shares_modulus = true;
        if (pair.tangential == TangentialLaw::incremental_slip ||
            pair.tangential == TangentialLaw::linear_spring)
            changes.mixed = true;
        return;
    }
    if (pair.tangential == TangentialLaw::mindlin) changes.mixed = true;
    if (pair.normal == NormalLaw::walton_braun) {
        if (keeps_latch(request, pair)) {
            (pair.restitution_speed ? changes.luding : changes.edinburgh) = true;
        } else {
            changes.latch = true;
            changes.table |= !pair.restitution_table.empty();
            changes.fixed_speed |= pair.restitution_speed.has_value();
            pair.normal = NormalLaw::spring_dashpot;
            pair.restitution_speed.reset();
            pair.tangential_damping = 0.0;
        }
    }
    if (pair.tangential == TangentialLaw::incremental_slip) {
        changes.slip = true;
        pair.tangential = TangentialLaw::linear_spring;
    }
}

constexpr const char* cost =
    "in a wedge of 640 grains shaken at three times gravity the bed stood 0.4 mm from where it stood before, "
    "and grains had 40 % fewer contacts";

void say_latch(const CarryRequest& request, const LawChanges& changes, CarriedScene& carried) {
    const std::string where = carried.scene.where("contact.law");
    const std::string what =
        "Walton-Braun's latching spring becomes a spring with a dashpot of the same stiffness and "
        "restitution";
    if (request.accept_law) {
        add_change(carried, where, what, std::string("neither engine has that law under MPI; ") + cost);
        return;
    }
    add_refusal(
        carried, where,
        fmt::format("the law walton-braun is none that {} has under MPI; with --accept law it becomes "
                    "a spring with a dashpot of the same stiffness and restitution ({}){}",
                    name_of(request.engine), cost,
                    changes.table
                        ? ""
                        : fmt::format("; nearest is LIGGGHTS on one rank: {} liggghts --law edinburgh",
                                      request.engine_option)));
}

void say_slip(const CarryRequest& request, CarriedScene& carried) {
    const std::string where = carried.scene.where("contact.friction_law");
    if (request.accept_law || request.edinburgh) {
        add_change(carried, where, "incremental slip becomes a linear spring of the same stiffness",
                   "neither engine has that law; it takes part in the change of contacts that stands above");
        return;
    }
    add_refusal(
        carried, where,
        fmt::format("friction by incremental-slip is none that {} has; with --accept law it becomes a "
                    "linear spring of the same stiffness",
                    name_of(request.engine)));
}

void say_changes(const CarryRequest& request, const LawChanges& changes, CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (changes.latch) say_latch(request, changes, carried);
    if (changes.slip) say_slip(request, carried);
    if (changes.fixed_speed && request.accept_law)
        add_change(carried, scene.where("contact.restitution_speed"),
                   "a restitution that falls with speed becomes what it is at its speed, for all speeds",
                   request.engine == PeerEngine::lammps ? "LAMMPS has no such law; LIGGGHTS has (luding)"
                                                        : "--law edinburgh has one restitution");
    if (changes.table && request.accept_law)
        add_change(carried, scene.where("contact.restitution_table"),
                   "a table of restitutions becomes one restitution", "neither engine has tables");
    if (changes.shares_modulus)
        add_refusal(carried, scene.where("contact.law"),
                    fmt::format("hertz: LIGGGHTS takes moduli by material, and no E* by kind of contact; "
                                "LAMMPS takes it ({} lammps)",
                                request.engine_option));
    if (changes.mixed)
        add_refusal(
            carried, scene.where("contact.friction_law"),
            fmt::format("this friction law beside this normal law is none that {} is told; hertz goes "
                        "with mindlin, the others with linear-spring",
                        name_of(request.engine)));
}

}  // namespace

void carry_laws(const CarryRequest& request, const Plan&, CarriedScene& carried) {
    LawChanges changes;
    SceneContacts& contact = carried.scene.contact;
    for (std::vector<PairContact>* kind : {&contact.grain, &contact.wall, &contact.mesh})
        for (PairContact& pair : *kind) carry_law(request, pair, changes);
    say_changes(request, changes, carried);
    if (request.edinburgh && request.engine != PeerEngine::liggghts)
        add_refusal(carried, "--law edinburgh",
                    fmt::format("is a law of LIGGGHTS; use {} liggghts", request.engine_option));
    if (request.edinburgh && request.ranks > 1)
        add_refusal(carried, "--law edinburgh",
                    "loses its latch where a pair changes its rank; use --ranks 1");
    if (contact.arms == LeverArms::radius) {
        contact.arms = LeverArms::contact_plane;
        add_change(carried, carried.scene.where("contact.arms"),
                   "forces act at the contact plane, not at the full radius", "both engines do so");
    }
    Run& run = carried.scene.run;
    if (run.integrator != Integrator::velocity_verlet) {
        run.integrator = Integrator::velocity_verlet;
        add_change(carried, carried.scene.where("run.integrator"), "steps are made by velocity Verlet",
                   "it is what both engines have");
    }
    if (run.contact_corrections) {
        run.contact_corrections = false;
        add_change(carried, carried.scene.where("run.contact_corrections"),
                   "contacts are not corrected within a step", "the engines do not know when they begin");
    }
    run.precision = Precision::full;
}

double tsuji_damping(double e) {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

// The polynomial falls over the whole interval, so halving it finds the root.
std::optional<double> tsuji_restitution(double alpha) {
    double low = -0.5, high = 1;
    if (alpha > tsuji_damping(low)) return std::nullopt;
    if (alpha <= tsuji_damping(high)) return high;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (tsuji_damping(middle) > alpha ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace grainreel
