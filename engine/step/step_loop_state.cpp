// What the step loop shows of its contacts, and what it saves.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/binary.hpp"
#include "engine/step/lists/saved_lists.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

void StepLoop::visit_contacts(std::int64_t at_step,
                              const std::function<void(const ContactView&)>& visit) const {
    WallState walls;
    const Pose pose = around_.motion.at(at_step);
    walls.set(around_.faces, pose, pose, 0);
    std::vector<ContactView> late;
    for (std::size_t g = 0; g < rules_.groups.size(); ++g) {
        const bool of_pairs = rules_.groups[g].of_pairs, rubs = rules_.groups[g].law->rubs;
        late.clear();
        for (const Member& m : members_) {
            m.contacts.observe(
                rules_, g, grains_, walls,
                [&](std::int32_t i, std::int32_t j, bool is_late, int at, const TouchChunk& touch,
                    const ForceChunk& force, const EnergyChunk& energy) {
                    const std::int32_t second = of_pairs ? j : -1 - j;
                    const ContactView seen = view(rubs, i, second, at, touch, force, energy);
                    is_late ? late.push_back(seen) : visit(seen);
                });
        }
        // Threads own stretches of the grains, so those in order are in order on any number of them.
        std::sort(late.begin(), late.end(), [](const ContactView& a, const ContactView& b) {
            return a.first != b.first ? a.first < b.first : a.second > b.second;
        });
        for (const ContactView& seen : late) visit(seen);
    }
}

ContactView StepLoop::view(bool rubs, std::int32_t first, std::int32_t second, int at,
                           const TouchChunk& touch, const ForceChunk& force,
                           const EnergyChunk& energy) const {
    const auto of = [at](const Row* axes) { return Vec3(axes[0][at], axes[1][at], axes[2][at]); };
    const Place& one = grains_.place[first];
    ContactView v{};
    v.first = first;
    v.second = second;
    v.normal = of(touch.normal);
    v.overlap = touch.overlap[at];
    v.smaller_radius = second < 0 ? one.radius : std::min(one.radius, grains_.place[second].radius);
    v.normal_force = force.normal[at];
    v.tangential = rubs ? of(force.tangential) : Vec3::Zero();
    v.stored_energy = energy.stored[at];
    v.sideways_energy = energy.sideways[at];
    v.latched_energy = energy.latched[at];
    v.damping_power = energy.damping[at];
    v.rubbing_power = energy.rubbing[at];
    v.point = one.position + v.normal * (one.radius - 0.5 * v.overlap);
    return v;
}

namespace {

// The order in which contacts are computed.
KeptContacts in_order(const KeptContacts& kept, int numbers) {
    std::vector<std::int32_t> order(kept.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return order_of(kept, a) < order_of(kept, b); });
    KeptContacts sorted;
    for (const std::int32_t c : order) {
        sorted.first.push_back(kept.first[c]);
        sorted.second.push_back(kept.second[c]);
        sorted.tag.push_back(kept.tag[c]);
        const auto history = kept.history.begin() + static_cast<std::ptrdiff_t>(c) * numbers;
        sorted.history.insert(sorted.history.end(), history, history + numbers);
    }
    return sorted;
}

}  // namespace

// All contacts in one order, whoever works on them.
std::vector<KeptContacts> StepLoop::all_kept() const {
    std::vector<KeptContacts> all(rules_.groups.size()), part;
    for (const Member& m : members_) {
        m.contacts.keep(part);
        for (std::size_t g = 0; g < part.size(); ++g) all[g].append(part[g]);
    }
    for (std::size_t g = 0; g < all.size(); ++g) all[g] = in_order(all[g], rules_.groups[g].history_size());
    return all;
}

// Everything saved, in its order.
template <class Loop, class Kept, class ReachType, class Each>
void StepLoop::transfer(Loop& loop, Kept& kept, std::int32_t& steps, ReachType& reach, const Each& each) {
    for (auto& group : kept) each(group.first), each(group.second), each(group.tag), each(group.history);
    each(steps);
    each(loop.lists_.pairs.start), each(loop.lists_.pairs.partner);
    each(loop.lists_.pairs.farthest_partner);
    each(loop.lists_.walls);
    each(loop.listed_at_), each(loop.listed_velocity_), each(loop.listed_pose_), each(loop.listed_step_);
    each(loop.skin_);
    each(reach);
}

void StepLoop::save(std::ostream& out) const {
    const std::vector<KeptContacts> kept = all_kept();
    std::int32_t steps = members_[0].contacts.steps_since_refresh();
    transfer(*this, kept, steps, members_[0].reach, Writing{out});
    if (traffic_.any()) write_value(out, traffic_);
}

void StepLoop::load(Bytes& in) {
    std::vector<KeptContacts> kept(rules_.groups.size());
    Reach reach;
    std::int32_t steps = 0;
    transfer(*this, kept, steps, reach, Reading{in});
    if (in.left() > 0) read_value(in, traffic_);
    if (!is_sound(kept, steps, reach)) in.fail();
    if (in.failed()) return;  // the caller says so
    fresh_ = false;
    if (team_.size() > 1) contacts_.assign(grains_.size(), 0);
    share_out();
    for (int member = 0; member < team_.size(); ++member) {
        Member& mine = members_[member];
        mine.reach = reach;
        mine.contacts = {};
        mine.contacts.own(rules_, lists_, share_[member], share_[member + 1]);
        mine.contacts.restore(rules_, kept, steps);
        mine.contacts.note_loads(grains_);
    }
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    place_halos();
    for (Member& mine : members_) {
        mine.contacts.list_candidates(rules_, grains_, lists_, around_.faces, reach.pose, reach.skin);
        if (team_.size() > 1) mine.contacts.list_foreign(rules_, grains_, share_);
    }
}

namespace {

bool is_finite(const Pose& pose) {
    return pose.offset.allFinite() && pose.velocity.allFinite() && std::isfinite(pose.time);
}

}  // namespace

bool StepLoop::is_traffic_sound() const {
    constexpr std::int64_t kMostIds = std::int64_t{1} << 31;
    const Traffic& t = traffic_;
    const auto known = [&](std::int32_t id) { return id < t.next_id; };
    return !t.any() || (t.came >= 0 && t.left >= 0 && std::isfinite(t.energy_in) &&
                        std::isfinite(t.energy_out) && std::isfinite(t.work_out) && t.next_id <= kMostIds &&
                        (t.came == 0 || std::all_of(grains_.id.begin(), grains_.id.end(), known)));
}

// Of what load() read: whether the loop could have made it, with these grains and faces.
bool StepLoop::is_sound(const std::vector<KeptContacts>& kept, std::int32_t steps, const Reach& reach) const {
    constexpr std::int32_t kMostSteps = 1'000'000'000;  // without a refresh, even of a bed at rest
    const auto count = static_cast<std::int32_t>(grains_.size());
    const auto faces = static_cast<std::int32_t>(around_.faces.size());
    const auto finite = [](const auto& v) { return v.allFinite(); };
    bool sound = steps >= 0 && steps <= kMostSteps && are_sound(lists_, count, faces) &&
                 std::ssize(listed_at_) == count && std::isfinite(listed_step_) && is_finite(listed_pose_) &&
                 listed_velocity_.allFinite() && skin_ >= kLeastSkin * around_.skin &&
                 skin_ <= kMostSkin * around_.skin && reach.skin >= 0 && reach.skin <= skin_ &&
                 reach.moved >= 0 && std::isfinite(reach.moved) && std::isfinite(reach.fastest) &&
                 reach.parted >= 0 && reach.drift.allFinite() && is_finite(reach.pose) &&
                 std::all_of(listed_at_.begin(), listed_at_.end(), finite);
    sound = sound && is_traffic_sound();
    for (std::size_t g = 0; sound && g < kept.size(); ++g)
        sound = are_sound(kept[g], rules_, g, grains_, faces, steps);
    return sound;
}

}  // namespace grainreel
