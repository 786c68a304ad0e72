// What the energy of a gas of smooth grains makes of the step's errors: it must stay where impacts are
// elastic, and fall by what they lose where they nearly are.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"

namespace grainreel {

// 216 grains, a tenth of the space solid, between walls of their own restitution.
struct GasSetting {
    std::string name, law = "walton-braun";
    std::vector<std::string> sets = {};  // further keys of its scene ("run.integrator=gear")
    // The contact corrections, or not, whatever the plan takes.
    enum class Corrected { as_planned, no, yes } corrected = Corrected::as_planned;
    double forces_a_contact = 0;  // 0: as planned
};
Plan gas_plan(const GasSetting& setting, double restitution);

struct GasEnergy {
    std::int64_t steps = 0;
    // Over the energy at first. `gained`: by the errors of the step, so what the gas has more than it should
    // after what latching and dashpots took, which is `lost`.
    double gained = 0, lost = 0;
};
// At rising times, counted in contacts: pi sqrt(m_eff / K) of the linear spring. Empty when goes_on(), asked
// a few times a second, says no.
std::vector<GasEnergy> gas_energy(const Plan& plan, std::uint64_t seed, const std::vector<double>& times,
                                  const std::function<bool()>& goes_on);

}  // namespace grainreel
