// Which law each contact has there.
#include <fmt/format.h>

#include "engine/handover/carry.hpp"

namespace grainreel {

namespace {

// What happens to the contacts of a scene, each told once.
struct LawChanges {
    bool latch = false;           // Walton-Braun becomes a spring with a dashpot
    bool slip = false;            // incremental slip becomes a linear spring
    bool fixed_speed = false;     // a restitution by speed becomes one number
    bool shares_modulus = false;  // Hertz, where moduli belong to materials
    bool mixed = false;           // Hertz and a linear tangential spring, or the other way round
    bool table = false;           // a table of restitutions, which no engine has
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
                    changes.table ? "" : "; nearest is LIGGGHTS on one rank: --to liggghts --law edinburgh"));
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
                    "hertz: LIGGGHTS takes moduli by material, and no E* by kind of contact; "
                    "LAMMPS takes it (--to lammps)");
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
    Contact& contact = carried.scene.contact;
    for (std::vector<PairContact>* kind : {&contact.grain, &contact.wall, &contact.mesh})
        for (PairContact& pair : *kind) carry_law(request, pair, changes);
    say_changes(request, changes, carried);
    if (request.edinburgh && request.engine != PeerEngine::liggghts)
        add_refusal(carried, "--law edinburgh", "is a law of LIGGGHTS; use --to liggghts");
    if (request.edinburgh && request.ranks > 1)
        add_refusal(carried, "--law edinburgh",
                    "loses its latch where a pair changes its rank; use --ranks 1");
    if (contact.arms == LeverArms::radius) {
        contact.arms = LeverArms::contact_plane;
        add_change(carried, carried.scene.where("contact.lever_arms"),
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

}  // namespace grainreel
