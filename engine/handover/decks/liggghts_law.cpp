// Writes a scene's contact law as LIGGGHTS states it: models and their properties by pairs of types.
#include "engine/handover/decks/decks.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

// The contact of two types, or of a type and a surface. Two surfaces never touch; for them it is some contact
// of the second one.
const CarriedPair& pair_at(const CarriedScene& carried, std::size_t a, std::size_t b) {
    const std::size_t types = carried.type_count();
    if (a < types && b < types) return carried.between(a, b);
    const std::size_t surface = std::max(a, b) - types, type = std::min(a, b);
    return carried.surfaces[surface].with[type < types ? type : 0];
}

bool any(const CarriedScene& carried, const std::function<bool(const CarriedPair&)>& is) {
    for (const CarriedPair& pair : carried.pairs)
        if (pair.touches && is(pair)) return true;
    for (const CarriedSurface& surface : carried.surfaces)
        for (const CarriedPair& pair : surface.with)
            if (pair.touches && is(pair)) return true;
    return false;
}

std::string matrix(const CarriedScene& carried, const std::string& name,
                   const std::function<double(const CarriedPair&)>& value) {
    const std::size_t all = carried.type_count() + carried.surfaces.size();
    std::string line = fmt::format("fix p_{} all property/global {} peratomtypepair {}", name, name, all);
    for (std::size_t a = 0; a < all; ++a)
        for (std::size_t b = 0; b < all; ++b) line += fmt::format(" {}", value(pair_at(carried, a, b)));
    return line;
}

double stiffness_of(const CarriedPair& pair) {
    return pair.stiffness > 0 ? pair.stiffness : 1;
}

CarriedLaw law_of(const CarriedScene& carried) {
    for (const CarriedPair& pair : carried.pairs)
        if (pair.touches) return pair.law;
    return carried.surfaces.empty() || carried.surfaces.front().with.empty()
               ? CarriedLaw::spring_dashpot
               : carried.surfaces.front().with.front().law;
}

LiggghtsLaw spring_dashpot(const CarriedScene& carried) {
    LiggghtsLaw law;
    law.model = "model hooke/stiffness tangential history";
    const bool pulls = any(carried, [](const CarriedPair& pair) { return pair.attraction; });
    // LIGGGHTS adds tangential damping after Coulomb's limit. It is switched on only if some contact of the
    // scene has such damping.
    const bool damps = any(carried, [](const CarriedPair& pair) { return pair.tangential_damping > 0; });
    law.flags = fmt::format("absolute_damping off limitForce {} tangential_damping {}", pulls ? "off" : "on",
                            damps ? "on" : "off");
    law.properties = {
        matrix(carried, "kn", stiffness_of),
        matrix(carried, "kt", [](const CarriedPair& pair) { return pair.tangential; }),
        matrix(carried, "gamman", [](const CarriedPair& pair) { return pair.damping; }),
        matrix(carried, "gammat", [](const CarriedPair& pair) { return pair.tangential_damping; })};
    return law;
}

// Adds the properties of a law that unloads along a steeper line. Such laws have no dashpot.
void add_steeper(const CarriedScene& carried, const std::function<double(const CarriedPair&)>& ratio,
                 LiggghtsLaw& law) {
    law.properties.push_back(matrix(carried, "LoadingStiffness", stiffness_of));
    law.properties.push_back(matrix(carried, "UnloadingStiffness", ratio));
    law.properties.push_back(
        matrix(carried, "coefficientAdhesionStiffness", [](const auto&) { return 0.0; }));
    law.properties.push_back(matrix(carried, "coefficientRestitution", [](const auto&) { return 1.0; }));
    law.properties.push_back(matrix(carried, "pullOffForce", [](const auto&) { return 0.0; }));
}

LiggghtsLaw luding(const CarriedScene& carried) {
    LiggghtsLaw law;
    law.model = "model luding tangential history";
    law.flags = "tangential_damping off limitForce on";
    add_steeper(
        carried, [](const auto&) { return kLudingRatio; }, law);
    law.properties.push_back(matrix(carried, "coefficientPlasticityDepth", luding_depth));
    return law;
}

LiggghtsLaw edinburgh(const CarriedScene& carried) {
    LiggghtsLaw law;
    law.model = "model edinburgh/stiffness tangential history";
    law.flags = "tangential_damping off limitForce on fixKc off";
    add_steeper(
        carried,
        [](const CarriedPair& pair) {
            return pair.stiffness > 0 ? std::max(1.0, pair.unloading / pair.stiffness) : 1.0;
        },
        law);
    law.properties.push_back(matrix(carried, "surfaceEnergy", [](const auto&) { return 0.0; }));
    law.properties.emplace_back("fix p_overlapExponent all property/global overlapExponent scalar 1.0");
    law.properties.emplace_back("fix p_adhesionExponent all property/global adhesionExponent scalar 1.0");
    return law;
}

}  // namespace

double luding_depth(const CarriedPair& pair) {
    constexpr double r = kLudingRatio;
    if (!(pair.hardening > 0) || !(pair.effective_radius > 0)) return 1e3;  // the contact never stiffens
    return (r - 1) * (r - 1) / (2 * r * pair.hardening * pair.effective_radius);
}

LiggghtsLaw liggghts_law(const CarriedScene& carried) {
    const CarriedLaw kind = law_of(carried);
    // Hertz' law has been refused before: LIGGGHTS takes E and nu for each type, not for each pair.
    GRAINREEL_CHECK(kind != CarriedLaw::hertz);
    LiggghtsLaw law = kind == CarriedLaw::luding      ? luding(carried)
                      : kind == CarriedLaw::edinburgh ? edinburgh(carried)
                                                      : spring_dashpot(carried);
    law.properties.push_back(
        matrix(carried, "coefficientFriction", [](const CarriedPair& pair) { return pair.friction; }));
    if (any(carried, [](const CarriedPair& pair) { return pair.rolling > 0; })) {
        law.model += " rolling_friction epsd2";
        law.properties.push_back(matrix(carried, "coefficientRollingFriction",
                                        [](const CarriedPair& pair) { return pair.rolling; }));
    }
    return law;
}

}  // namespace grainreel
