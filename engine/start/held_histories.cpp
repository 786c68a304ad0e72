#include "engine/start/held_histories.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "engine/base/lists.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/start/restart.hpp"
#include "engine/step/lists/contact_rules.hpp"

namespace grainreel {

namespace {

enum class Sort : std::uint8_t { pair, wall, glued, mesh };

// Names the two bodies of a contact: two ids of grains, or a grain's id and the number of a face, of a
// glued grain or of a mesh.
struct Bodies {
    std::int32_t first, second;
    Sort sort;
    bool operator==(const Bodies&) const = default;
};
struct HashOfBodies {
    std::size_t operator()(const Bodies& of) const {
        const auto low = static_cast<std::uint32_t>(of.second) * 4 + static_cast<std::uint32_t>(of.sort);
        return std::hash<std::uint64_t>()(std::uint64_t{static_cast<std::uint32_t>(of.first)} << 34 ^ low);
    }
};

struct Held {
    std::int32_t group, at;  // group of the origin's rules, and place in its list
    bool turned;             // the two bodies are in the other order
};

Sort sort_of(const ContactGroup& group) {
    if (group.of_pairs) return Sort::pair;
    return group.of_glued ? Sort::glued : group.of_mesh ? Sort::mesh : Sort::wall;
}

// For each face of the origin, the number of the face of that name here; -1 for none.
std::vector<std::int32_t> faces_here(const std::vector<Face>& there, const std::vector<Face>& here) {
    std::vector<std::int32_t> number;
    for (const Face& face : there) {
        const auto same = [&](const Face& other) { return other.name == face.name; };
        const auto found = std::find_if(here.begin(), here.end(), same);
        number.push_back(found == here.end() ? -1 : static_cast<std::int32_t>(found - here.begin()));
    }
    return number;
}

// For each mesh of the origin, the number of the mesh here with its name, content and place; -1 for none.
std::vector<std::int32_t> meshes_here(const std::vector<MeshWall>& there, const std::vector<MeshWall>& here) {
    std::vector<std::int32_t> number;
    for (const MeshWall& mesh : there) {
        const auto same = [&](const MeshWall& other) {
            return other.name == mesh.name && other.surface->hash() == mesh.surface->hash();
        };
        const auto found = std::find_if(here.begin(), here.end(), same);
        number.push_back(found == here.end() ? -1 : static_cast<std::int32_t>(found - here.begin()));
    }
    return number;
}

class HeldHistories {
  public:
    HeldHistories(const Scene& scene, const Plan& plan, const Surroundings& around, const StartOrigin& origin,
                  const Grains& grains)
        : plan_(plan),
          origin_(origin.plan),
          grains_(grains),
          rules_(plan, around.period),
          rules_there_(origin.plan, origin.around.period),
          same_glued_(same_glued_grains(around.glued, origin.around.glued)),
          mesh_(meshes_here(origin.around.meshes, around.meshes)),
          kept_(contacts_from_checkpoint(scene, rules_there_, origin.parts())) {
        // Ids in the checkpoint's own order, by which its contacts count.
        const std::vector<std::int32_t> id = grains_from_checkpoint(scene).id;
        const std::vector<std::int32_t> face = faces_here(origin.around.faces, around.faces);
        for (std::size_t g = 0; g < kept_.size(); ++g)
            for (std::size_t c = 0; c < kept_[g].size(); ++c) note(g, c, id, face);
        for (const Bodies& bodies : in_several_places_) held_.erase(bodies);
    }

    bool fill(std::size_t g, std::int32_t first, std::int32_t second, double* to) const {
        const ContactGroup& group = rules_.groups[g];
        const std::int32_t other = group.of_pairs ? grains_.id[second] : second;
        const auto found = held_.find({grains_.id[first], other, sort_of(group)});
        if (found == held_.end() || !acts_alike(group, first, second)) return false;
        const ContactGroup& there = rules_there_.groups[found->second.group];
        if (group.law->history_size != there.law->history_size) return false;
        // A contact with a patch of a mesh has more numbers behind those of its law; these stay as they are
        // here.
        const int size = there.law_size();
        const double* from = kept_[found->second.group].history.data() +
                             static_cast<std::ptrdiff_t>(found->second.at) * there.history_size();
        for (int k = 0; k < group.law_size(); ++k) {
            to[k] = k < size ? from[k] : 0;
            if (found->second.turned && group.turns(k)) to[k] = -to[k];
        }
        return true;
    }

  private:
    void note(std::size_t g, std::size_t c, const std::vector<std::int32_t>& id,
              const std::vector<std::int32_t>& face) {
        if (kept_[g].tag[c] < 0) return;  // this contact has ended
        const Sort sort = sort_of(rules_there_.groups[g]);
        const std::int32_t first = id[kept_[g].first[c]], second = kept_[g].second[c];
        const auto group = static_cast<std::int32_t>(g), at = static_cast<std::int32_t>(c);
        if (sort == Sort::pair) {
            held_[{first, id[second], sort}] = {group, at, false};
            held_[{id[second], first, sort}] = {group, at, true};
        } else if (sort == Sort::glued) {
            if (same_glued_) held_[{first, second, sort}] = {group, at, false};
        } else if (sort == Sort::mesh) {
            const std::int32_t mesh = mesh_[mesh_of(second)];
            const Bodies bodies{first, mesh, sort};
            if (mesh >= 0 && !held_.insert({bodies, {group, at, false}}).second)
                in_several_places_.push_back(bodies);
        } else if (face[second] >= 0) {
            held_[{first, face[second], sort}] = {group, at, false};
        }
    }

    bool acts_alike(const ContactGroup& group, std::int32_t first, std::int32_t second) const {
        const auto one = static_cast<std::size_t>(grains_.species[first]);
        if (group.of_pairs) {
            const auto other = static_cast<std::size_t>(grains_.species[second]);
            return act_alike(plan_.between(one, other), origin_.between(one, other));
        }
        if (group.of_mesh) {
            const std::size_t before = place_in(mesh_, second).value();
            return act_alike(plan_.at_mesh(static_cast<std::size_t>(second), one),
                             origin_.at_mesh(before, one));
        }
        if (!group.of_glued) return act_alike(plan_.wall[one], origin_.wall[one]);
        return !origin_.glued.empty() && act_alike(plan_.glued[one], origin_.glued[one]);
    }

    const Plan &plan_, &origin_;
    const Grains& grains_;
    const ContactRules rules_, rules_there_;
    const bool same_glued_;
    const std::vector<std::int32_t> mesh_;   // the number here of each mesh of the origin; -1 for none
    std::vector<Bodies> in_several_places_;  // pairs of a grain and a mesh with several contacts, whose
                                             // histories cannot be told apart
    const std::vector<KeptContacts> kept_;
    std::unordered_map<Bodies, Held, HashOfBodies> held_;
};

template <class Each>
void each_pair_of_kinds(const Plan& one, const Plan& other, const Each& each) {
    for (const auto kinds : {&Plan::grain, &Plan::wall, &Plan::glued, &Plan::mesh}) {
        const std::size_t both = std::min((one.*kinds).size(), (other.*kinds).size());
        for (std::size_t k = 0; k < both; ++k) each(act_alike((one.*kinds)[k], (other.*kinds)[k]));
    }
}

}  // namespace

void take_histories(const Scene& scene, const Plan& plan, const Surroundings& around,
                    const StartOrigin& origin, const Grains& grains, StepLoop& loop) {
    const HeldHistories held(scene, plan, around, origin, grains);
    loop.take_histories([&](std::size_t group, std::int32_t first, std::int32_t second, double* to) {
        return held.fill(group, first, second, to);
    });
}

bool all_act_alike(const Plan& one, const Plan& other) {
    bool all = one.wall.size() == other.wall.size() && one.glued.size() == other.glued.size() &&
               one.mesh.size() == other.mesh.size();
    each_pair_of_kinds(one, other, [&](bool alike) { all = all && alike; });
    return all;
}

bool any_act_alike(const Plan& one, const Plan& other) {
    bool any = false;
    each_pair_of_kinds(one, other, [&](bool alike) { any = any || alike; });
    return any && one.wall.size() == other.wall.size();
}

bool acts_alike_in(const Plan& other, const Plan& one, const PairPlan& pair) {
    for (const auto kinds : {&Plan::grain, &Plan::wall, &Plan::glued, &Plan::mesh}) {
        const std::vector<PairPlan>&here = one.*kinds, &there = other.*kinds;
        for (std::size_t k = 0; k < std::min(here.size(), there.size()); ++k)
            if (&here[k] == &pair) return act_alike(here[k], there[k]);
    }
    return false;
}

namespace {

// Index of a grain; index of its partner (grain, face, glued grain or mesh); number of the sort of partner.
using BodyKey = std::tuple<std::int32_t, std::int32_t, int>;

// Number of the mesh that this wall is; below 0 for a face.
std::int32_t mesh_of(const ContactView& c, const Surroundings& around) {
    return -1 - c.second - static_cast<std::int32_t>(around.faces.size());
}

BodyKey bodies_of(const ContactView& c, const Surroundings& around) {
    if (c.second >= 0) return {c.first, c.second, 0};
    if (c.glued >= 0) return {c.first, c.glued, 1};
    const std::int32_t mesh = mesh_of(c, around);
    return mesh < 0 ? BodyKey{c.first, -1 - c.second, 2} : BodyKey{c.first, mesh, 3};
}

BodyKey bodies_of(const ContactGroup& group, std::int32_t first, std::int32_t second) {
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

// The restitution at a speed, by straight lines between the rows, constant beyond the ends.
double restitution_at(const std::vector<RestitutionPoint>& table, double speed) {
    const auto above =
        std::find_if(table.begin(), table.end(), [&](const auto& p) { return p.speed > speed; });
    if (above == table.begin() || above == table.end())
        return above == table.end() ? table.back().restitution : table.front().restitution;
    const RestitutionPoint& below = *(above - 1);
    return below.restitution +
           (speed - below.speed) / (above->speed - below.speed) * (above->restitution - below.restitution);
}

// K2 (N/m) of a contact whose largest overlap was `largest`, between grains of the pair's effective mass.
double unloading(const PairPlan& pair, double largest) {
    const double k1 = pair.loading_stiffness;
    if (pair.hardening > 0) return k1 * (1 + pair.hardening * largest);
    if (pair.restitution_table.empty()) return pair.unloading_stiffness;
    const double e = restitution_at(pair.restitution_table, largest * std::sqrt(k1 / pair.effective_mass));
    return k1 / (e * e);
}

// The largest overlap (m) that leaves a contact of this overlap this share of its force; found by halving.
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
    std::map<BodyKey, Latch> fresh;
    const WeightSums moments(around.gravity, grains);
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
        // A grain may touch a mesh in several places, which cannot be told apart below; the smallest
        // overlap is kept.
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
        to[0] = latched(pair, found->second.overlap, share);  // a_max, the first number of each such history
        // The third number of WaltonBraunCorrected::History is the softness 1 / K2.
        if (pair.model.normal == NormalForce::walton_braun_corrected) to[2] = 1 / pair.unloading_stiffness;
        return true;
    });
}

WeightSums::WeightSums(const Vec3& gravity, const Grains& grains) : grains_(grains) {
    if (gravity.norm() > 0) up_ = -gravity / gravity.norm();
    lowest_ = std::numeric_limits<double>::infinity();
    for (const Place& p : grains.place) lowest_ = std::min(lowest_, up_.dot(p.position) - p.radius);
    for (std::size_t i = 0; i < grains.size(); ++i)
        of_weights_ += grains.mass(i) * gravity.norm() * height(grains.place[i].position);
}

double WeightSums::carried(const ContactView& contact) const {
    const Place& first = grains_.place[contact.first];
    const double along = up_.dot(contact.normal);
    // The force on the first body points against the normal.
    if (contact.second < 0) return -along * height(first.position);
    return along * along * (first.radius + grains_.place[contact.second].radius - contact.overlap);
}

}  // namespace grainreel
