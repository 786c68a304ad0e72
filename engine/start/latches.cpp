#include "engine/start/latches.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/start/weight_moments.hpp"
#include "engine/step/lists/contact_rules.hpp"

namespace grainreel {

namespace {

// Index of a grain; of the other grain, of the face or of the glued grain; and the group's sort.
using Bodies = std::tuple<std::int32_t, std::int32_t, int>;

Bodies bodies_of(const ContactView& c) {
    if (c.second >= 0) return {c.first, c.second, 0};
    return c.glued >= 0 ? Bodies{c.first, c.glued, 1} : Bodies{c.first, -1 - c.second, 2};
}

Bodies bodies_of(const ContactGroup& group, std::int32_t first, std::int32_t second) {
    return {first, second, group.of_pairs ? 0 : group.of_glued ? 1 : 2};
}

const PairPlan& plan_of(const Plan& plan, const Grains& grains, const ContactView& c) {
    const auto one = static_cast<std::size_t>(grains.species[c.first]);
    if (c.second >= 0) return plan.between(one, static_cast<std::size_t>(grains.species[c.second]));
    return c.glued >= 0 ? plan.glued[one] : plan.wall[one];
}

bool latches(const PairPlan& pair) {
    return (pair.model.normal == NormalForce::walton_braun ||
            pair.model.normal == NormalForce::walton_braun_corrected) &&
           pair.unloading_stiffness > pair.loading_stiffness;
}

double latched(const PairPlan& pair, double overlap, double share) {
    const double e2 = pair.loading_stiffness / pair.unloading_stiffness;
    return overlap * (1 - share * e2) / (1 - e2);
}

}  // namespace

void set_latches(const Plan& plan, const Surroundings& around, const Grains& grains,
                 const std::function<bool(const PairPlan&)>& is_fresh, StepLoop& loop) {
    constexpr std::int64_t kBefore = -1;  // walls stand as restart() had them
    struct Latch {
        const PairPlan* pair;
        double overlap;
    };
    std::map<Bodies, Latch> fresh;
    const WeightMoments moments(around.gravity, grains);
    double wanted = moments.of_weights(), there = 0;
    loop.visit_contacts(kBefore, [&](const ContactView& c) {
        const PairPlan& pair = plan_of(plan, grains, c);
        const double carried = c.normal_force * moments.carried(c);
        if (!latches(pair) || !is_fresh(pair)) {
            wanted -= carried;
            return;
        }
        there += carried;
        fresh[bodies_of(c)] = {&pair, c.overlap};
    });
    if (!(there > wanted)) return;
    const double share = std::max(0.0, wanted / there);
    const ContactRules rules(plan, around.period);
    loop.take_histories([&](std::size_t g, std::int32_t first, std::int32_t second, double* to) {
        const ContactGroup& group = rules.groups[g];
        const auto found = fresh.find(bodies_of(group, first, second));
        if (found == fresh.end()) return false;
        const PairPlan& pair = *found->second.pair;
        std::fill_n(to, group.history_size(), 0.0);
        to[0] = latched(pair, found->second.overlap, share);  // a_max, which both laws have first
        if (pair.model.normal == NormalForce::walton_braun_corrected) to[2] = 1 / pair.unloading_stiffness;
        return true;
    });
}

}  // namespace grainreel
