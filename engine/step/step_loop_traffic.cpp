// Lets grains leave and enter, and lets walls change, between two steps. Grains that stay keep their order,
// their forces and their histories, so that nothing depends on the threads. A grain that has lost a contact
// in this way begins its next step with the forces of those contacts that it keeps.

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/step/lists/change_owners.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

// Leaves out the values whose new index is kGone. The others keep their order.
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

Departure departure_of(const Grains& grains, std::size_t i, const Vec3& gravity, std::int64_t step) {
    const Motion& motion = grains.motion[i];
    Departure gone;
    gone.step = step;
    gone.id = grains.id[i];
    gone.species = grains.species[i];
    gone.radius = grains.place[i].radius;
    gone.mass = grains.mass(i);
    gone.position = grains.place[i].position;
    gone.velocity = motion.velocity;
    gone.spin = motion.spin;
    gone.energy = grains.mass(i) * (0.5 * motion.velocity.squaredNorm() - gravity.dot(gone.position)) +
                  0.5 * grains.inertia(i) * motion.spin.squaredNorm();
    return gone;
}

bool is_in(const Exit::HalfSpace& side, const Vec3& centre, double reach) {
    return side.normal.dot(centre) < side.distance + reach;
}

}  // namespace

bool StepLoop::in_exit(std::int32_t i) const {
    return std::any_of(around_.exits.begin(), around_.exits.end(),
                       [&](const Exit& exit) { return exit.holds(grains_.place[i].position); });
}

// Whether the run must stop at the end of this step because a grain of this member (a thread of the team) may
// leave then.
//
// If the scheme still moves grains after the forces, the run stops when a grain comes near an exit. How near
// depends only on the grain, not on the threads, because these schemes round differently where a run stops.
// In a step a grain moves by its velocity times the step, and by what the forces add to that. The addition is
// far less than a hundredth of its radius, since a contact lasts many steps.
bool StepLoop::may_leave(int member, double step) const {
    constexpr double kPushed = 0.01;  // as a share of a radius
    if (around_.exits.empty()) return false;
    const bool moves = scheme_.moves_after_forces();
    // Successive grains lie near each other, so a grain is mostly outside the same half-space as the grain
    // before it. That half-space is looked at first.
    for (const Exit& exit : around_.exits) {
        if (exit.sides.empty()) continue;
        Exit::HalfSpace far = exit.sides.front();
        for (std::int32_t i = lists_.begin(member); i < lists_.end(member); ++i) {
            const Vec3& centre = grains_.place[i].position;
            double reach = 0;
            if (moves) reach = kPushed * grains_.place[i].radius + step * grains_.motion[i].velocity.norm();
            if (!is_in(far, centre, reach)) continue;
            const auto other = std::find_if_not(exit.sides.begin(), exit.sides.end(),
                                                [&](const auto& side) { return is_in(side, centre, reach); });
            if (other == exit.sides.end()) return true;
            far = *other;
        }
    }
    return false;
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
        if (contains(ids, grains_.id[i])) leavers.push_back(i);
    take_out(leavers, step);
}

// Takes out grains, given by rising indices, at the end of the step before `step`.
void StepLoop::take_out(const std::vector<std::int32_t>& leavers, std::int64_t step) {
    if (leavers.empty()) return;
    std::vector<bool> lose_a_contact = note_departures(leavers, step);
    const std::vector<std::int32_t>& index = lists_.leave_out(leavers);
    leave_out(grains_, index);
    leave_out(lose_a_contact, index);
    lists_.renew_shares();
    sum_loads_anew(lose_a_contact, step);
}

// Notes the grains that leave, in the order of their ids. Returns which grains lose a contact by that.
std::vector<bool> StepLoop::note_departures(const std::vector<std::int32_t>& leavers, std::int64_t step) {
    std::vector<double> stored(grains_.size(), 0.0);
    std::vector<bool> leaves(grains_.size(), false), lose(grains_.size(), false);
    for (const std::int32_t i : leavers) leaves[i] = true;
    visit_contacts(step, [&](const ContactView& c) {
        const bool first = leaves[c.first];
        if (!first && (c.second < 0 || !leaves[c.second])) return;
        stored[first ? c.first : c.second] += c.stored_energy;
        lose[c.first] = true;
        if (c.second >= 0) lose[c.second] = true;
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
    return lose;
}

// Sums the loads of some grains from their contacts as they are now. If the next step does not begin with a
// kick by these forces, the loads stay zero.
void StepLoop::sum_loads_anew(const std::vector<bool>& of, std::int64_t step) {
    if (!contains(of, true)) return;
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i]) grains_.load[i] = {};
    if (scheme_.moves_after_forces()) return;
    visit_contacts(step, [&](const ContactView& c) {
        const Vec3 on_second = c.normal_force * c.normal + c.tangential;
        if (of[c.first]) {
            grains_.load[c.first].force -= on_second;
            grains_.load[c.first].torque += c.torque_on_first;
        }
        if (c.second >= 0 && of[c.second]) {
            grains_.load[c.second].force += on_second;
            grains_.load[c.second].torque += c.torque_on_second;
        }
    });
}

// Contacts with parts of faces that vanish lose their stored energy, which counts as energy that has left.
void StepLoop::open_faces(const std::function<void()>& change, std::int64_t step) {
    std::vector<bool> at_a_wall(grains_.size(), false);
    const auto stored = [&] {
        double sum = 0;
        visit_contacts(step, [&](const ContactView& c) {
            if (c.second >= 0) return;
            at_a_wall[c.first] = true;
            sum += c.stored_energy;
        });
        return sum;
    };
    const double before = stored();
    change();
    traffic_.energy_out += before - stored();
    ++traffic_.openings;
    sum_loads_anew(at_a_wall, step);
}

std::vector<Departure> StepLoop::take_departures() {
    return std::exchange(departures_, {});
}

std::int32_t StepLoop::insert(const std::vector<ComingGrain>& more) {
    GRAINREEL_CHECK(lists_.are_made());
    for (const std::int32_t id : grains_.id)
        traffic_.next_id = std::max<std::int64_t>(traffic_.next_id, id + std::int64_t{1});
    const auto first = static_cast<std::int32_t>(traffic_.next_id);
    for (const ComingGrain& grain : more) add(grain);
    if (!more.empty()) lists_.renew_shares();
    return first;
}

void StepLoop::add(const ComingGrain& grain) {
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
    lists_.add_unlisted();
    ++traffic_.came;
    traffic_.energy_in += departure_of(grains_, grains_.size() - 1, around_.gravity, 0).energy;
}

// The functions below sum the forces on the walls, if an observer asks for them.

namespace {

// Heights (m) of the walls' points at rest.
std::vector<double> heights_of_walls(const Surroundings& around) {
    std::vector<double> heights;
    for (const Face& face : around.faces) heights.push_back(face.point.z());
    for (const MeshWall& mesh : around.meshes) heights.push_back(mesh.point.z());
    return heights;
}

// Vector (m) from a wall's point to a place.
Vec3 arm_at(const Surroundings& around, std::size_t wall, const DrivePose& pose, const Vec3& place) {
    if (wall >= around.faces.size()) {
        const MeshWall& mesh = around.meshes[wall - around.faces.size()];
        return place - mesh.body.at(pose).moved(mesh.point);
    }
    const Face& face = around.faces[wall];
    if (face.body.has_own_motion()) return place - face.body.at(pose).moved(moment_point(face));
    return place - face.point - face.displacement(pose);
}

}  // namespace

void StepLoop::tally_walls(const WallScale& scale, std::int64_t step) {
    if (members_[0].walls.tally != nullptr) {
        for (Member& m : members_) m.tally.begin_anew();
        return;
    }
    for (Member& m : members_) {
        m.tally.begin(heights_of_walls(around_), scale);
        m.walls.tally = &m.tally;
    }
    // The forces at the start give the first half kick, so they are counted.
    const DrivePose pose = around_.motion.at(step);
    members_[0].tally.begin_evaluation(last_share());
    visit_contacts(step, [&](const ContactView& c) {
        if (c.second >= 0) return;
        const std::int32_t wall = -1 - c.second;
        members_[0].tally.add(wall, c.normal_force * c.normal + c.tangential, c.normal_force,
                              arm_at(around_, static_cast<std::size_t>(wall), pose, c.point), c.rolling);
    });
}

void StepLoop::go_on_tallying(const WallSums& before, const WallScale& scale) {
    for (Member& m : members_) {
        m.tally.begin(heights_of_walls(around_), scale);
        m.walls.tally = &m.tally;
    }
    members_[0].tally.take(before);
}

// Share of a step for which the forces of its last evaluation act.
double StepLoop::last_share() const {
    return scheme_.acts(scheme_.stages.size() - 1);
}

WallSums StepLoop::wall_sums() const {
    WallSums all;
    for (const Member& m : members_) m.tally.add_to(all);
    all.scale = members_[0].tally.scale();
    all.felt = last_share() > 0 ? scheme_.stages.back().kick / last_share() : 0;
    return all;
}

}  // namespace grainreel
