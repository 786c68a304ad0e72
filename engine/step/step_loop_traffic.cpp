// Grains leave and enter between two steps. Those that stay keep their order, their forces and their
// histories, so that nothing depends on the threads. (A force of the step's end acts for half a step more,
// also one by a grain that has left: an error of the order of the step, once for each such contact.)
#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

constexpr std::int32_t kGone = ContactPass::kGone;

// Leaves those out whose new index is kGone; the others keep their order.
template <class Values>
void leave_out(Values& values, const std::vector<std::int32_t>& index) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index[i] != kGone) values[kept++] = values[i];
    values.resize(kept);
}

void leave_out(Grains& grains, const std::vector<std::int32_t>& index) {
    leave_out(grains.id, index), leave_out(grains.species, index), leave_out(grains.wall_work, index);
    leave_out(grains.place, index), leave_out(grains.motion, index), leave_out(grains.load, index);
    leave_out(grains.rounded, index), leave_out(grains.orientation, index);
    leave_out(grains.derivatives, index);
}

void leave_out(NeighbourList& list, const std::vector<std::int32_t>& index) {
    std::size_t grains = 0, partners = 0;
    list.farthest_partner = 0;
    std::int32_t from = 0;
    for (std::size_t i = 0; i < index.size(); ++i) {
        const std::int32_t begin = std::exchange(from, list.start[i + 1]);
        if (index[i] == kGone) continue;
        for (std::int32_t at = begin; at < from; ++at) {
            const std::int32_t partner = index[static_cast<std::size_t>(list.partner[at])];
            if (partner == kGone) continue;
            list.farthest_partner = std::max(list.farthest_partner, partner - index[i]);
            list.partner[partners++] = partner;
        }
        list.start[++grains] = static_cast<std::int32_t>(partners);
    }
    list.start.resize(grains + 1);
    list.partner.resize(partners);
}

void leave_out(std::vector<WallNeighbour>& walls, const std::vector<std::int32_t>& index) {
    std::size_t kept = 0;
    for (const WallNeighbour& w : walls)
        if (index[static_cast<std::size_t>(w.grain)] != kGone)
            walls[kept++] = {index[static_cast<std::size_t>(w.grain)], w.face};
    walls.resize(kept);
}

Departure departure_of(const Grains& grains, std::size_t i, const Vec3& gravity, std::int64_t step) {
    const Motion& motion = grains.motion[i];
    Departure gone;
    gone.step = step;
    gone.id = grains.id[i];
    gone.species = grains.species[i];
    gone.radius = grains.place[i].radius;
    gone.position = grains.place[i].position;
    gone.velocity = motion.velocity;
    gone.spin = motion.spin;
    gone.energy = grains.mass(i) * (0.5 * motion.velocity.squaredNorm() - gravity.dot(gone.position)) +
                  0.5 * grains.inertia(i) * motion.spin.squaredNorm();
    return gone;
}

}  // namespace

bool StepLoop::in_exit(std::int32_t i) const {
    return std::any_of(around_.exits.begin(), around_.exits.end(),
                       [&](const Exit& exit) { return exit.holds(grains_.place[i].position); });
}

// Whether the run must stop at the end of this step, for a grain of this member's may leave then. Where the
// scheme moves grains once more after the forces, nobody knows yet, and the run stops at every step.
bool StepLoop::may_leave(int member) const {
    if (around_.exits.empty()) return false;
    if (scheme_.corrects || scheme_.closing_drift > 0) return true;
    // Of most exits the first half-space tells that a grain is not in them.
    for (const Exit& exit : around_.exits) {
        if (exit.sides.empty()) continue;
        const Exit::HalfSpace first = exit.sides.front();
        for (std::int32_t i = share_[member]; i < share_[member + 1]; ++i) {
            const Vec3& centre = grains_.place[i].position;
            if (first.normal.dot(centre) < first.distance && exit.holds(centre)) return true;
        }
    }
    return false;
}

bool StepLoop::anyone_may_leave(const Member& mine) const {
    return std::any_of(members_.begin(), members_.end(),
                       [&](const Member& m) { return m.told[mine.box].may_leave; });
}

void StepLoop::let_leave(std::int64_t step) {
    std::vector<std::int32_t> leavers;
    for (std::int32_t i = 0; i < std::ssize(grains_.id); ++i)
        if (in_exit(i)) leavers.push_back(i);
    take_out(leavers, step);
}

void StepLoop::remove(const std::vector<std::int32_t>& ids, std::int64_t step) {
    std::vector<std::int32_t> leavers;
    for (std::int32_t i = 0; i < std::ssize(grains_.id); ++i)
        if (std::find(ids.begin(), ids.end(), grains_.id[i]) != ids.end()) leavers.push_back(i);
    take_out(leavers, step);
}

// Grains by index, rising; at the end of the step before `step`.
void StepLoop::take_out(const std::vector<std::int32_t>& leavers, std::int64_t step) {
    if (leavers.empty()) return;
    note_departures(leavers, step);
    std::vector<std::int32_t>& index = new_index_;
    index.assign(grains_.size(), 0);
    for (const std::int32_t i : leavers) index[i] = kGone;
    std::int32_t next = 0;
    for (std::int32_t& i : index)
        if (i != kGone) i = next++;
    for (std::int32_t& share : share_)
        share -= static_cast<std::int32_t>(std::lower_bound(leavers.begin(), leavers.end(), share) -
                                           leavers.begin());
    leave_out(grains_, index);
    leave_out(lists_.pairs, index);
    leave_out(lists_.walls, index);
    leave_out(listed_at_, index);
    for (Member& m : members_) m.contacts.leave_out(rules_, index);
    renew_shares();
}

// In order of their ids.
void StepLoop::note_departures(const std::vector<std::int32_t>& leavers, std::int64_t step) {
    std::vector<double> stored(grains_.size(), 0.0);
    std::vector<bool> leaves(grains_.size(), false);
    for (const std::int32_t i : leavers) leaves[i] = true;
    visit_contacts(step, [&](const ContactView& c) {
        const bool first = leaves[c.first];
        if (first || (c.second >= 0 && leaves[c.second]))
            stored[first ? c.first : c.second] += c.stored_energy;
    });
    std::vector<Departure> gone;
    for (const std::int32_t i : leavers) {
        gone.push_back(departure_of(grains_, static_cast<std::size_t>(i), around_.gravity, step));
        gone.back().energy += stored[i];
        traffic_.work_out += grains_.wall_work[i];
        traffic_.next_id = std::max<std::int64_t>(traffic_.next_id, gone.back().id + 1);
    }
    std::sort(gone.begin(), gone.end(), [](const Departure& a, const Departure& b) { return a.id < b.id; });
    for (const Departure& one : gone) traffic_.energy_out += one.energy;
    traffic_.left += std::ssize(gone);
    departures_.insert(departures_.end(), gone.begin(), gone.end());
}

std::vector<Departure> StepLoop::take_departures() {
    return std::exchange(departures_, {});
}

std::int32_t StepLoop::insert(const std::vector<NewGrain>& more) {
    GRAINREEL_CHECK(!share_.empty());
    for (const std::int32_t id : grains_.id)
        traffic_.next_id = std::max<std::int64_t>(traffic_.next_id, id + std::int64_t{1});
    const auto first = static_cast<std::int32_t>(traffic_.next_id);
    for (const NewGrain& grain : more) add(grain);
    if (more.empty()) return first;
    for (Member& m : members_) m.reach.moved = kNowhere;  // used up
    share_.back() = static_cast<std::int32_t>(grains_.size());
    renew_shares();
    return first;
}

void StepLoop::add(const NewGrain& grain) {
    grains_.add(static_cast<std::int32_t>(traffic_.next_id++), grain.species, grain.position, grain.radius,
                grain.density);
    Motion& motion = grains_.motion.back();
    motion.velocity = grain.velocity;
    motion.spin = grain.spin;
    if (!grains_.orientation.empty()) grains_.orientation.push_back(Quaternion::Identity());
    if (carries_derivatives()) {
        grains_.derivatives.emplace_back();
        grains_.derivatives.back().acceleration = around_.gravity;
    }
    // It was listed nowhere, so that the lists are made again at the end of the next step.
    listed_at_.push_back(Eigen::Vector3f::Constant(kNowhere));
    lists_.pairs.start.push_back(lists_.pairs.start.back());
    ++traffic_.came;
    traffic_.energy_in += departure_of(grains_, grains_.size() - 1, around_.gravity, 0).energy;
}

// Whose grains are whose after some left or came: they have new indices, and nobody's lists are in order.
void StepLoop::renew_shares() {
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    team_.run([&](int member) {
        Member& mine = members_[member];
        mine.contacts.own(rules_, lists_, share_[member], share_[member + 1]);
        team_.barrier(member);
        if (member == 0) place_halos();
        team_.barrier(member);
        refresh(member);
        mine.contacts.note_loads(grains_);
    });
}

}  // namespace grainreel
