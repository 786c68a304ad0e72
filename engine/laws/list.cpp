// All combinations of laws. A new law needs its header and one line here.
#include "engine/base/error.hpp"
#include "engine/laws/frictionless.hpp"
#include "engine/laws/incremental_slip.hpp"
#include "engine/laws/linear_spring.hpp"
#include "engine/laws/spring_dashpot.hpp"
#include "engine/laws/walton_braun.hpp"
#include "engine/step/law_loop.hpp"

namespace grainreel {

namespace {

template <class Normal>
std::unique_ptr<StepLoop> with_normal(const Plan& plan, const Surroundings& around, Grains& grains,
                                      Team& team) {
    switch (plan.tangential) {
        case TangentialLaw::incremental_slip:
            return std::make_unique<LawLoop<ContactLaw<Normal, IncrementalSlip>>>(plan, around, grains, team);
        case TangentialLaw::linear_spring:
            return std::make_unique<LawLoop<ContactLaw<Normal, LinearSpring>>>(plan, around, grains, team);
        case TangentialLaw::none:
            return std::make_unique<LawLoop<ContactLaw<Normal, Frictionless>>>(plan, around, grains, team);
    }
    check_failed("a known tangential law", __FILE__, __LINE__);
}

}  // namespace

std::unique_ptr<StepLoop> make_step_loop(const Plan& plan, const Surroundings& around, Grains& grains,
                                         Team& team) {
    switch (plan.normal) {
        case NormalLaw::walton_braun:
            return with_normal<WaltonBraun>(plan, around, grains, team);
        case NormalLaw::spring_dashpot:
            return with_normal<SpringDashpot>(plan, around, grains, team);
    }
    check_failed("a known normal law", __FILE__, __LINE__);
}

}  // namespace grainreel
