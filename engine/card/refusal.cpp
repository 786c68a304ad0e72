#include "engine/card/refusal.hpp"

#include <algorithm>

#include "engine/card/device.hpp"

namespace grainreel::card {

namespace {

// Powers of other numbers have no kernels: they are a library's.
bool has_power(double gamma) {
    return gamma == 1.0 / 3.0 || gamma == 1 || gamma == 2;
}

std::string of_law(const PairPlan& pair) {
    if (pair.model.own) return "a contact law of one's own";
    if (pair.model.precision == Precision::mixed) return "mixed precision";
    if (!has_kernels(pair.model)) return "this pair of contact laws";
    if (pair.model.tangential == TangentialLaw::incremental_slip && !has_power(pair.gamma))
        return "incremental slip with an exponent other than 1/3, 1 and 2";
    return "";
}

std::string of_wall(const Face& face) {
    if (face.ends) return "a wall that ends at an edge, as that with an outlet does";
    if (face.body.has_own_motion()) return "a wall that turns or moves by itself";
    return "";
}

}  // namespace

std::string what_a_card_refuses(const Plan& plan, const Surroundings& around) {
    if (plan.integrator == Integrator::gear) return "Gear's method";
    if (!around.meshes.empty()) return "a mesh";
    if (!around.glued.empty()) return "grains glued to walls";
    if (!around.exits.empty()) return "an exit";
    for (const auto* kinds : {&plan.grain, &plan.wall})
        for (const PairPlan& pair : *kinds)
            if (const std::string what = of_law(pair); !what.empty()) return what;
    for (const Face& face : around.faces)
        if (const std::string what = of_wall(face); !what.empty()) return what;
    return "";
}

}  // namespace grainreel::card
