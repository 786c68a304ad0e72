// The keys of one kind of contact, as [contact], [contact.wall] and [[contact.pair]] have them.
#include <fmt/format.h>

#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;

// For linear-spring: a sphere then oscillates along the normal and sideways with the same period.
constexpr double spring_ratio = 2.0 / 7;
constexpr double mindlin_ratio = 2 * (1 - 0.3) / (2 - 0.3);  // for Mindlin, at Poisson's ratio 0.3

using Reason = const char*;

Reason of_walton_braun(const PairContact& laws) {
    return laws.normal != NormalLaw::walton_braun ? "only the law walton-braun has it" : nullptr;
}

Reason of_friction(const PairContact& laws) {
    return laws.tangential == TangentialLaw::none ? "'friction_law' is \"none\"" : nullptr;
}

Reason of_incremental_slip(const PairContact& laws) {
    if (const Reason none = of_friction(laws)) return none;
    return laws.tangential != TangentialLaw::incremental_slip ? "only incremental-slip has it" : nullptr;
}

Reason of_dashpots(const PairContact& laws) {
    return laws.normal == NormalLaw::walton_braun ? "the law walton-braun has no damping" : nullptr;
}

Reason of_free_dashpots(const PairContact& laws) {
    if (const Reason none = of_dashpots(laws)) return none;
    return laws.normal == NormalLaw::hertz ? "the damping of hertz follows from the restitution" : nullptr;
}

Reason of_tangential_dashpots(const PairContact& laws) {
    if (const Reason none = of_free_dashpots(laws)) return none;
    if (const Reason none = of_friction(laws)) return none;
    return laws.tangential == TangentialLaw::incremental_slip ? "incremental-slip has no damping" : nullptr;
}

Reason of_linear_springs(const PairContact& laws) {
    return laws.normal == NormalLaw::hertz ? "hertz has a 'modulus'" : nullptr;
}

Reason of_hertz(const PairContact& laws) {
    return laws.normal != NormalLaw::hertz ? "only the law hertz has it" : nullptr;
}

bool says_restitution_otherwise(const PairContact& pair) {
    return pair.normal_damping || !pair.restitution_table.empty();
}

void usual_ratio(PairContact& pair, const Scene&) {
    if (pair.tangential == TangentialLaw::linear_spring) pair.tangential_ratio = spring_ratio;
    if (pair.tangential == TangentialLaw::mindlin) pair.tangential_ratio = mindlin_ratio;
}

void read_restitution_table(Document& document, const Scene&, const std::string& path, PairContact& pair) {
    std::vector<RestitutionPoint> points;
    for (const auto& [speed, restitution] : document.speed_table(path)) {
        if (restitution <= 0 || restitution > 1)
            document.fail(
                path,
                fmt::format("has a restitution of {:.6g}; it must be larger than 0, at most 1", restitution));
        if (speed < 0 || (!points.empty() && speed <= points.back().speed))
            document.fail(path, "must have rising speeds, none below 0; sort its rows");
        points.push_back({speed, restitution});
    }
    pair.restitution_table = points;
}

std::string restitution_table_text(const PairContact& pair, const Scene&) {
    std::vector<std::string> rows;
    for (const RestitutionPoint& p : pair.restitution_table)
        rows.push_back(toml_list({toml_number(p.speed), toml_number(p.restitution)}));
    return rows.empty() ? "" : toml_list(rows);
}

BoundKey<PairContact> restitution_table_key() {
    BoundKey<PairContact> bound = bound_by<PairContact>(
        of_dimension(entry("restitution_table", KeyKind::speed_table, note("none"),
                           "walton-braun only, instead: [speed, restitution] by rising speed, at most "
                           "8 rows; straight lines between them, constant beyond."),
                     Dimension::speed, any),
        read_restitution_table, restitution_table_text);
    bound.copy = [](const PairContact& from, PairContact& to) {
        to.restitution_table = from.restitution_table;
    };
    return bound;
}

// The order in a written scene: laws, losses, springs, friction.
enum Place { of_laws, of_losses, of_springs, of_rubbing };

Fallback of_the_pair() {
    return note("that of the pair, if it is given; else chosen by the plan");
}

}  // namespace

TangentialLaw suiting(NormalLaw law) {
    switch (law) {
        case NormalLaw::walton_braun:
            return TangentialLaw::incremental_slip;
        case NormalLaw::spring_dashpot:
            return TangentialLaw::linear_spring;
        case NormalLaw::hertz:
            return TangentialLaw::mindlin;
    }
    return TangentialLaw::none;
}

const KeyTable<PairContact>& contact_table() {
    using P = PairContact;
    static const KeyTable<P> table{
        quantity("restitution", &P::restitution, Dimension::number, share, initial(),
                 "Speed after over speed before a normal impact.")
            .unwritten_if(says_restitution_otherwise)
            .written_at(of_losses),
        quantity(
            "restitution_speed", &P::restitution_speed, Dimension::speed, positive,
            note("none: the same at any speed"),
            "walton-braun only: the speed at which `restitution` holds; slower impacts lose less, faster "
            "ones more.")
            .useless_for(of_walton_braun)
            .unwritten_if(says_restitution_otherwise)
            .written_at(of_losses),
        restitution_table_key().excludes({"restitution"}).useless_for(of_walton_braun).written_at(of_losses),
        quantity("friction", &P::friction, Dimension::number, not_negative_or_infinite, initial(),
                 "Coulomb's µ; 0 for none, inf to never slip.")
            .useless_for(of_friction)
            .written_at(of_rubbing),
        quantity("rolling_friction", &P::rolling_friction, Dimension::number, not_negative, initial(),
                 "Torque against rolling, at most so much x effective radius x normal force; 0 for none.")
            .useless_for(of_friction)
            .written_at(of_rubbing),
        quantity("stiffness", &P::stiffness, Dimension::stiffness, positive, note("chosen by the plan"),
                 "Of the loading branch: K1 (walton-braun) or kn (spring-dashpot).")
            .often_chosen()
            .useless_for(of_linear_springs)
            .written_at(of_springs),
        quantity("modulus", &P::stiffness, Dimension::pressure, positive, note("chosen by the plan"),
                 "hertz only: E* of the pair, 1/E* = (1 - ν²)/E + the same of the other body.")
            .often_chosen()
            .useless_for(of_hertz)
            .written_at(of_springs),
        quantity("glued_stiffness", &P::glued_stiffness, Dimension::stiffness, positive, of_the_pair(),
                 "As `stiffness`, of contacts with a grain that is glued to a wall.")
            .often_chosen()
            .useless_for(of_linear_springs)
            .written_at(of_springs),
        quantity("glued_modulus", &P::glued_stiffness, Dimension::pressure, positive, of_the_pair(),
                 "As `modulus`, of contacts with a grain that is glued to a wall.")
            .often_chosen()
            .useless_for(of_hertz)
            .written_at(of_springs),
        quantity("tangential_ratio", &P::tangential_ratio, Dimension::number, {0, 1000, true, false},
                 note("0.8; linear-spring 2/7, mindlin 0.824"),
                 "Tangential stiffness divided by normal stiffness; 2(1 - ν)/(2 - ν) for mindlin.")
            .usually(usual_ratio)
            .useless_for(of_friction)
            .written_at(of_rubbing),
        quantity("gamma", &P::gamma, Dimension::number, {0, 100, false, false}, note("1/3"),
                 "Exponent of incremental-slip: 1/3 resembles Mindlin, 1 or 2 plastic contacts.")
            .useless_for(of_incremental_slip)
            .written_at(of_rubbing),
        quantity("normal_damping", &P::normal_damping, Dimension::rate, not_negative,
                 note("from the restitution"),
                 "spring-dashpot only, instead of the restitution: force = value x effective mass x speed.")
            .excludes({"restitution"})
            .useless_for(of_free_dashpots)
            .written_at(of_losses),
        quantity("tangential_damping", &P::tangential_damping, Dimension::rate, not_negative,
                 note("half the normal damping"), "spring-dashpot with linear-spring only.")
            .useless_for(of_tangential_dashpots)
            .written_at(of_rubbing),
        flag("attraction", &P::attraction, initial(),
             "spring-dashpot, hertz: the dashpot may pull at the end of contact.")
            .useless_for(of_dashpots)
            .written_at(of_laws),
        choice("law", &P::normal, normal_law_words, initial(),
               "Normal force: latching spring; linear spring with a dashpot; Hertz with one.")
            .read_at(-2)
            .written_at(of_laws - 2),
        choice("friction_law", &P::tangential, tangential_law_words,
               note("incremental-slip; linear-spring for spring-dashpot, mindlin for hertz"),
               "Tangential force; none leaves out friction, spin and torque.")
            .read_at(-1)
            .written_at(of_laws - 1),
    };
    return table;
}

}  // namespace grainreel
