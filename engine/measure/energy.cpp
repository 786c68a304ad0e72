#include "engine/measure/energy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/step/step_loop.hpp"

namespace grainreel {

Kinetic kinetic_energy(const Grains& grains) {
    Kinetic sum;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        sum.translation += 0.5 * grains.motion[i].velocity.squaredNorm() * grains.mass(i);
        sum.rotation += 0.5 * grains.motion[i].spin.squaredNorm() * grains.inertia(i);
    }
    return sum;
}

double gravitational_energy(const Grains& grains, const Vec3& gravity) {
    double sum = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
        sum -= grains.mass(i) * gravity.dot(grains.place[i].position);
    return sum;
}

double wall_work(const Grains& grains) {
    return std::accumulate(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
}

ContactSummary summarise_contacts(const StepLoop& loop, std::int64_t step) {
    ContactSummary sum;
    loop.visit_contacts(step, [&](const ContactView& c) {
        sum.stored += c.stored_energy;
        sum.largest_overlap = std::max(sum.largest_overlap, c.overlap / c.smaller_radius);
        if (c.normal_force > 0) sum.carrying += c.second >= 0 ? 2 : 1;
    });
    return sum;
}

double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step) {
    const Kinetic kinetic = kinetic_energy(grains);
    return kinetic.translation + kinetic.rotation + gravitational_energy(grains, around.gravity) +
           summarise_contacts(loop, step).stored;
}

namespace {

std::vector<BodyPose> poses_of_meshes(const Surroundings& around, const DrivePose& pose) {
    std::vector<BodyPose> poses;
    for (const MeshWall& mesh : around.meshes) poses.push_back(mesh.body.at(pose));
    return poses;
}

// Velocity (m/s) of the wall at the contact. `pose` is the pose of the drive.
Vec3 velocity_of_wall(const Surroundings& around, const std::vector<BodyPose>& meshes, const ContactView& c,
                      const DrivePose& pose) {
    const auto wall = static_cast<std::size_t>(-1 - c.second);
    const std::size_t faces = around.faces.size();
    return wall < faces ? velocity_of(around.faces[wall], pose, c.point)
                        : meshes[wall - faces].velocity_at(c.point);
}

// Spin (rad/s) of the wall of a contact. `pose` is the pose of the drive.
Vec3 spin_of_wall(const Surroundings& around, const std::vector<BodyPose>& meshes, const ContactView& c,
                  const DrivePose& pose) {
    const auto wall = static_cast<std::size_t>(-1 - c.second);
    const std::size_t faces = around.faces.size();
    if (wall >= faces) return meshes[wall - faces].spin;
    const Body& body = around.faces[wall].body;
    return body.has_own_motion() ? body.at(pose).spin : Vec3(0, 0, 0);
}

}  // namespace

EnergyBalance::EnergyBalance(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                             std::int64_t step, double step_length)
    : around_(around), grains_(grains), loop_(loop), half_step_(0.5 * step_length) {
    look(step);
    const EnergyTerms now = terms_;
    terms_ = {now.kinetic, now.rotational, now.gravitational, now.stored};
    held_at_start_ = terms_.held();
    work_at_start_ = now.wall_work;
    came_at_start_ = traffic_.energy_in;
    left_at_start_ = traffic_.energy_out;
}

void EnergyBalance::note(std::int64_t step) {
    const Powers before = powers_;
    look(step);
    end_contacts();
    terms_.damping += half_step_ * (before.damping + powers_.damping);
}

void EnergyBalance::look(std::int64_t step) {
    const Kinetic kinetic = kinetic_energy(grains_);
    terms_.kinetic = kinetic.translation;
    terms_.rotational = kinetic.rotation;
    terms_.gravitational = gravitational_energy(grains_, around_.gravity);
    terms_.stored = 0;
    powers_ = {};
    const DrivePose pose = around_.motion.at(step);
    const std::vector<BodyPose> meshes = poses_of_meshes(around_, pose);
    if (!shown_.empty()) shown_.clear();
    std::swap(before_, contacts_);
    contacts_.clear();
    goes_on_.assign(before_.size(), 0);
    if (!places_.empty()) places_.clear();
    place_ = 0;
    loop_.visit_contacts(step, [&](const ContactView& c) {
        add_contact(step, c);
        terms_.stored += c.stored_energy;
        powers_.damping += c.damping_power;
        if (c.second >= 0) return;
        const Vec3 on_wall = c.normal_force * c.normal + c.tangential;
        powers_.walls -= on_wall.dot(velocity_of_wall(around_, meshes, c, pose));
        if (!c.rolling.isZero(0)) powers_.walls -= c.rolling.dot(spin_of_wall(around_, meshes, c, pose));
    });
    // Grains::wall_work counts the last force for a whole step, but half of that step is still to come.
    note_traffic();
    terms_.wall_work = wall_work(grains_) + traffic_.work_out - half_step_ * powers_.walls - work_at_start_;
}

void EnergyBalance::note_traffic() {
    const Traffic& now = loop_.traffic();
    if (now.left != traffic_.left) {
        present_ = grains_.id;
        std::sort(present_.begin(), present_.end());
    }
    some_left_ = now.left != traffic_.left;
    opened_ = now.openings != traffic_.openings;
    traffic_ = now;
    terms_.came = now.energy_in - came_at_start_;
    terms_.left = now.energy_out - left_at_start_;
}

// The contact as it was at the last step noted; null if it did not touch then.
const EnergyBalance::Kept* EnergyBalance::found(std::uint64_t key) {
    constexpr std::size_t nearby = 4;
    const std::size_t end = std::min(before_.size(), place_ + nearby);
    for (std::size_t at = place_; at < end; ++at) {
        if (before_[at].key != key) continue;
        place_ = at + 1;
        goes_on_[at] = 1;
        return &before_[at].kept;
    }
    if (touching_.insert(key).second) return nullptr;
    if (places_.empty())
        for (std::size_t k = 0; k < before_.size(); ++k) places_.emplace(before_[k].key, k);
    const std::size_t at = places_.at(key);
    goes_on_[at] = 1;
    return &before_[at].kept;
}

void EnergyBalance::add_contact(std::int64_t step, const ContactView& c) {
    const std::uint64_t key_of_c = key(c);
    const Kept* const known = found(key_of_c);
    const Kept kept = known != nullptr ? *known : Kept{step};
    terms_.latching += c.latched_energy - kept.latched;
    add_friction(half_step_ * (kept.rubbing + c.rubbing_power) - (c.sideways_energy - kept.sideways));
    contacts_.push_back({key_of_c, {step, c.latched_energy, c.sideways_energy, c.rubbing_power}});
}

// Energy that a tangential spring still held when its contact parted counts as friction. If a grain has left,
// or an outlet has opened below it, this energy has left with it. The energies are summed by rising keys, so
// the sum does not depend on the order of the contacts.
void EnergyBalance::end_contacts() {
    ended_.clear();
    for (std::size_t k = 0; k < before_.size(); ++k)
        if (!goes_on_[k]) ended_.push_back(k);
    std::sort(ended_.begin(), ended_.end(),
              [&](std::size_t a, std::size_t b) { return before_[a].key < before_[b].key; });
    for (const std::size_t k : ended_) {
        const auto& [key, kept] = before_[k];
        const bool went_out = (some_left_ && !are_there(key)) || (opened_ && is_at_wall(key));
        if (!went_out) add_friction(half_step_ * kept.rubbing + kept.sideways);
        touching_.erase(key);
    }
}

// Calls each() for everything that is saved except the contacts, in the order of the file.
template <class Balance, class Each>
void EnergyBalance::transfer(Balance& balance, const Each& each) {
    each(balance.powers_.walls), each(balance.powers_.damping);
    EnergyTerms::each(balance.terms_, each);
    each(balance.held_at_start_), each(balance.work_at_start_);
    each(balance.came_at_start_), each(balance.left_at_start_);
    each(balance.traffic_);
}

void EnergyBalance::save(std::ostream& out) const {
    std::vector<Touching> sorted = contacts_;
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
    std::vector<std::uint64_t> keys;
    std::vector<Kept> kept;
    for (const Touching& one : sorted) keys.push_back(one.key), kept.push_back(one.kept);
    const Writing each{out};
    each(keys), each(kept);
    transfer(*this, each);
}

void EnergyBalance::load(Bytes& in) {
    std::vector<std::uint64_t> keys;
    std::vector<Kept> kept;
    const Reading each{in};
    each(keys), each(kept);
    transfer(*this, each);
    const auto finite = [](const Kept& one) {
        return one.step >= 0 && std::isfinite(one.latched) && std::isfinite(one.sideways) &&
               std::isfinite(one.rubbing);
    };
    bool sound = keys.size() == kept.size() && std::is_sorted(keys.begin(), keys.end()) &&
                 std::adjacent_find(keys.begin(), keys.end()) == keys.end() &&
                 std::all_of(kept.begin(), kept.end(), finite) && std::isfinite(residual()) &&
                 std::isfinite(powers_.walls + powers_.damping + work_at_start_ + came_at_start_ +
                               left_at_start_ + terms_.given_back);
    if (in.failed() || !sound) return in.fail();
    contacts_.clear();
    touching_ = {keys.begin(), keys.end()};
    for (std::size_t k = 0; k < keys.size(); ++k) contacts_.push_back({keys[k], kept[k]});
}

void EnergyBalance::add_friction(double spent) {
    terms_.friction += spent;
    terms_.given_back += std::max(0.0, -spent);
}

bool EnergyBalance::are_there(std::uint64_t key) const {
    const auto there = [&](std::uint64_t id) {
        return std::binary_search(present_.begin(), present_.end(), static_cast<std::int32_t>(id));
    };
    const std::uint64_t second = key & 0xffffffff;
    return there(key >> 32) && (is_at_wall(key) || there(second));
}

// A grain may touch several glued grains of one face, so these are numbered after the faces. It may also
// touch a mesh in several places. These are numbered after the glued grains, in the order in which they are
// shown.
std::uint64_t EnergyBalance::key_at_wall(std::uint64_t first, const ContactView& c) {
    constexpr std::uint64_t most_places = 64;  // places of one grain at one mesh
    const auto wall = static_cast<std::uint64_t>(-1 - c.second);
    const std::uint64_t faces = around_.faces.size(), from = first << 32 | (std::uint64_t{1} << 31);
    if (c.glued >= 0) return from | (faces + static_cast<std::uint64_t>(c.glued));
    if (wall < faces) return from | wall;
    const std::uint64_t of_mesh = from | (faces + around_.glued.size() + (wall - faces) * most_places);
    return of_mesh + shown_[of_mesh]++;
}

// The key of a contact. It names grains by their ids, because indices change, and numbers walls after all
// grains.
std::uint64_t EnergyBalance::key(const ContactView& c) {
    const auto id = [&](std::int32_t index) { return static_cast<std::uint64_t>(grains_.id[index]); };
    const std::uint64_t first = id(c.first);
    if (c.second < 0) return key_at_wall(first, c);
    const std::uint64_t second = id(c.second);
    return std::min(first, second) << 32 | std::max(first, second);
}

}  // namespace grainreel
