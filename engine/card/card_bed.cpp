#include "engine/card/card_bed.hpp"

#include <algorithm>
#include <bit>

namespace grainreel::card {

CardBed::CardBed(std::unique_ptr<Device> device)
    : device_(std::move(device)),
      place_(*device_),
      motion_(*device_),
      load_(*device_),
      wall_work_(*device_),
      faces_(*device_),
      wall_motion_(*device_),
      species_(*device_),
      group_(*device_),
      status_(*device_),
      told_(*device_) {}

void CardBed::bring(const ContactRules& rules, const Grains& grains, const ThreadContacts& contacts) {
    bed_.grains = static_cast<std::int32_t>(grains.size());
    bed_.place = place_.send(grains.place);
    bed_.motion = motion_.send(grains.motion);
    bed_.load = load_.send(grains.load);
    bed_.wall_work = wall_work_.send(grains.wall_work);
    bed_.species = species_.send(grains.species);
    bed_.period = rules.period;
    bed_.rubs = rules.rubs;
    bed_.plane_arms = rules.arms == LeverArms::contact_plane;
    std::vector<Group> groups;
    for (std::size_t g = 0; g < rules.groups.size(); ++g) {
        if (g == groups_.size()) {
            groups_.emplace_back(*device_, rules.groups[g]);
            models_.push_back(rules.groups[g].model);
            of_pairs_.push_back(rules.groups[g].of_pairs);
        }
        groups_[g].bring(rules, contacts.tables[g], bed_.grains);
        groups.push_back(groups_[g].group());
    }
    bed_.group = group_.send(groups);
    bed_.groups = static_cast<std::int32_t>(groups.size());
    evaluations_ = 0;
    parted_now_ = contacts.parted();
}

void CardBed::send_status(const Status& status) {
    bed_.status = status_.send(&status, 1);
}

// Sends the walls of all steps.
void CardBed::send_walls(const std::vector<DeviceStep>& steps) {
    constexpr std::size_t kNumbers = sizeof(FaceRecord) / sizeof(double);
    static_assert(sizeof(FaceMotion) == sizeof(FaceRecord));
    std::vector<FaceRecord> faces;
    std::vector<FaceMotion> motion;
    for (const DeviceStep& step : steps) {
        faces.insert(faces.end(), step.walls.faces.begin(), step.walls.faces.end());
        motion.insert(motion.end(), step.walls.motion.begin(), step.walls.motion.end());
    }
    faces_of_step_ = kNumbers * (steps.empty() ? 0 : steps.front().walls.faces.size());
    faces_.send(faces);
    wall_motion_.send(motion);
}

// The k-th step of those whose walls were sent.
Step CardBed::step_of(const DeviceStep& from, std::size_t k, double skin) const {
    Step s{};
    s.number = evaluations_ + static_cast<std::int32_t>(k) + 1;
    s.told = static_cast<std::int32_t>(k);
    s.begins_run = from.begins_run;
    s.drags = from.kicks.keep != 1;
    s.any_round = from.walls.any_round;
    const Vec3 gravity = from.kicks.gravity + Vec3::Zero();  // no -0, as in integrate.cpp
    for (int a = 0; a < 3; ++a) s.gravity[a] = gravity[a], s.frame[a] = from.kicks.frame[a];
    s.end_kick = from.kicks.end_kick, s.begin_kick = from.kicks.begin_kick, s.keep = from.kicks.keep;
    s.closing_drift = from.kicks.closing_drift, s.drift = from.kicks.drift;
    s.since = from.times.since, s.ahead = from.times.ahead;
    s.acts = from.times.acts, s.turns = from.times.turns;
    s.wall_way = from.wall_way, s.skin = skin;
    s.faces = faces_.data() + k * faces_of_step_;
    s.wall_motion = wall_motion_.data() + k * faces_of_step_;
    return s;
}

void CardBed::run_forces(const Step& step, bool always) {
    for (std::size_t g = groups_.size(); g-- > 0;) {
        const Kernel meet{Kernel::Work::meet, groups_[g].group().places, static_cast<std::int32_t>(g),
                          models_[g], of_pairs_[g]};
        device_->run(meet, bed_, step, always);
    }
    device_->run({Kernel::Work::sum, bed_.grains}, bed_, step, always);
}

DeviceRun CardBed::run(const std::vector<DeviceStep>& steps, const Reach& reach) {
    send_walls(steps);
    send_status({reach.moved, reach.fastest, reach.parted, parted_now_, 0, 0});
    std::vector<Told> told(steps.size());
    bed_.told = told_.send(told);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const Step step = step_of(steps[k], k, reach.skin);
        device_->run({Kernel::Work::move, bed_.grains}, bed_, step, false);
        device_->run({Kernel::Work::count_evaluation, 1}, bed_, step, false);
        run_forces(step, false);
    }
    Status status;
    status_.get(&status, 1);
    told_.get(told.data(), told.size());
    DeviceRun done;
    done.expired = status.expired != 0;
    for (std::int32_t k = 0; k < status.evaluations; ++k) {
        const auto number = [&](int a) { return std::bit_cast<double>(told[k].fastest[a]); };
        done.told.push_back({Vec3(number(0), number(1), number(2)), told[k].parted});
    }
    evaluations_ += status.evaluations - status.expired;
    parted_now_ = status.parted_now;
    return done;
}

void CardBed::add_forces(const DeviceStep& step) {
    send_walls({step});
    send_status({0, 0, 0, 0, 0, 0});
    run_forces(step_of(step, 0, 0), true);
    Status status;
    status_.get(&status, 1);
    ++evaluations_;
    parted_now_ = status.parted_now;
}

void CardBed::fetch(const ContactRules& rules, Grains& grains, ThreadContacts& contacts) {
    place_.get(grains.place.data(), grains.size());
    motion_.get(grains.motion.data(), grains.size());
    load_.get(grains.load.data(), grains.size());
    wall_work_.get(grains.wall_work.data(), grains.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].fetch(rules, g, evaluations_, contacts);
}

}  // namespace grainreel::card
