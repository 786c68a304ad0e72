#include "engine/start/latches.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/start/weight_moments.hpp"
#include "engine/step/lists/contact_rules.hpp"

namespace grainreel {

namespace {

// Index of a grain; of the other grain, of the face, of the glued grain or of the mesh; and the group's sort.
using Bodies = std::tuple<std::int32_t, std::int32_t, int>;

// Number of the wall among the meshes; below 0 for a face.
std::int32_t mesh_of(const ContactView& c, const Surroundings& around) {
    return -1 - c.second - static_cast<std::int32_t>(around.faces.size());
}

Bodies bodies_of(const ContactView& c, const Surroundings& around) {
    if (c.second >= 0) return {c.first, c.second, 0};
    if (c.glued >= 0) return {c.first, c.glued, 1};
    const std::int32_t mesh = mesh_of(c, around);
    return mesh < 0 ? Bodies{c.first, -1 - c.second, 2} : Bodies{c.first, mesh, 3};
}

Bodies bodies_of(const ContactGroup& group, std::int32_t first, std::int32_t second) {
    return {first, second, group.of_pairs ? 0 : group.of_glued ? 1 : group.of_mesh ? 3 : 2};
}

const PairPlan& plan_of(const Plan& plan, const Surroundings& around, const Grains& grains,
                        const ContactView& c) {
    const auto one = static_cast<std::size_t>(grains.species[c.first]);
    if (c.second >= 0) return plan.between(one, static_cast<std::size_t>(grains.species[c.second]));
    if (c.glued >= 0) return plan.glued[one];
    const std::int32_t mesh = mesh_of(c, around);
    return mesh < 0 ? plan.wall[one] : plan.at_mesh(static_cast<std::size_t>(mesh), one);
}

bool latches(const PairPlan& pair) {
    return pair.model.normal != NormalForce::spring_dashpot && pair.model.normal != NormalForce::hertz &&
           pair.model.own == nullptr && pair.unloading_stiffness > pair.loading_stiffness;
}

// Straight lines between the rows, constant beyond.
double restitution_at(const std::vector<RestitutionPoint>& table, double speed) {
    const auto above =
        std::find_if(table.begin(), table.end(), [&](const auto& p) { return p.speed > speed; });
    if (above == table.begin() || above == table.end())
        return above == table.end() ? table.back().restitution : table.front().restitution;
    const RestitutionPoint& below = *(above - 1);
    return below.restitution +
           (speed - below.speed) / (above->speed - below.speed) * (above->restitution - below.restitution);
}

// N/m, K2 of a contact whose largest overlap was this one, of grains with the pair's effective mass.
double unloading(const PairPlan& pair, double largest) {
    const double k1 = pair.loading_stiffness;
    if (pair.hardening > 0) return k1 * (1 + pair.hardening * largest);
    if (pair.restitution_table.empty()) return pair.unloading_stiffness;
    const double e = restitution_at(pair.restitution_table, largest * std::sqrt(k1 / pair.effective_mass));
    return k1 / (e * e);
}

// m: the largest overlap that leaves a contact of this overlap so large a share of its force; by halves.
double latched(const PairPlan& pair, double overlap, double share) {
    const double k1 = pair.loading_stiffness, wanted = share * k1 * overlap;
    const auto force = [&](double largest) {
        return k1 * largest - unloading(pair, largest) * (largest - overlap);
    };
    double low = overlap, high = 2 * overlap;
    for (int k = 0; k < 60 && force(high) > wanted; ++k) low = high, high *= 2;
    for (int k = 0; k < 60; ++k) (force(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
    return low;
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
        const PairPlan& pair = plan_of(plan, around, grains, c);
        const double carried = c.normal_force * moments.carried(c);
        if (!latches(pair) || !is_fresh(pair)) {
            wanted -= carried;
            return;
        }
        there += carried;
        const auto [known, added] = fresh.insert({bodies_of(c, around), {&pair, c.overlap}});
        // A grain may touch a mesh in several places, which cannot be told apart below: the shallower counts.
        if (!added) known->second.overlap = std::min(known->second.overlap, c.overlap);
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
        to[0] = latched(pair, found->second.overlap, share);  // a_max, which all of them have first
        if (pair.model.normal == NormalForce::walton_braun_corrected) to[2] = 1 / pair.unloading_stiffness;
        return true;
    });
}

}  // namespace grainreel
