#include "engine/start/held_histories.hpp"

#include <algorithm>
#include <unordered_map>

#include "engine/start/restart.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel {

namespace {

enum class Sort : std::uint8_t { pair, wall, glued, mesh };

// Names two bodies: by the ids of two grains, or by a grain's id and the number of a face, of a glued grain
// or of a mesh.
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
    std::int32_t group, at;  // of the origin's rules; in its list
    bool turned;             // the bodies stand the other way round
};

Sort sort_of(const ContactGroup& group) {
    if (group.of_pairs) return Sort::pair;
    return group.of_glued ? Sort::glued : group.of_mesh ? Sort::mesh : Sort::wall;
}

// The number that each face of the origin has here, by its name; -1 for none.
std::vector<std::int32_t> faces_here(const std::vector<Face>& there, const std::vector<Face>& here) {
    std::vector<std::int32_t> number;
    for (const Face& face : there) {
        const auto same = [&](const Face& other) { return other.name == face.name; };
        const auto found = std::find_if(here.begin(), here.end(), same);
        number.push_back(found == here.end() ? -1 : static_cast<std::int32_t>(found - here.begin()));
    }
    return number;
}

// Likewise of meshes, by their names and what they are; they must stand where they stood.
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
        // In the checkpoint's own order, which its contacts count by.
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
        // What a patch of a mesh remembers behind the numbers of its laws stays as it is here.
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
        if (kept_[g].tag[c] < 0) return;  // it has parted
        const Sort sort = sort_of(rules_there_.groups[g]);
        const std::int32_t first = id[kept_[g].first[c]], second = kept_[g].second[c];
        const auto group = static_cast<std::int32_t>(g), at = static_cast<std::int32_t>(c);
        if (sort == Sort::pair) {
            held_[{first, id[second], sort}] = {group, at, false};
            held_[{id[second], first, sort}] = {group, at, true};
        } else if (sort == Sort::glued) {
            if (same_glued_) held_[{first, second, sort}] = {group, at, false};
        } else if (sort == Sort::mesh) {
            const std::int32_t mesh = mesh_[static_cast<std::size_t>(mesh_of(second))];
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
            const auto there =
                static_cast<std::size_t>(std::find(mesh_.begin(), mesh_.end(), second) - mesh_.begin());
            return act_alike(plan_.at_mesh(static_cast<std::size_t>(second), one),
                             origin_.at_mesh(there, one));
        }
        if (!group.of_glued) return act_alike(plan_.wall[one], origin_.wall[one]);
        return !origin_.glued.empty() && act_alike(plan_.glued[one], origin_.glued[one]);
    }

    const Plan &plan_, &origin_;
    const Grains& grains_;
    const ContactRules rules_, rules_there_;
    const bool same_glued_;
    const std::vector<std::int32_t> mesh_;  // the number here of each mesh of the origin; -1 for none
    std::vector<Bodies>
        in_several_places_;  // grains that touch a mesh so: which history is whose is not known
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

}  // namespace grainreel
