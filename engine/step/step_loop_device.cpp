// The step loop on another machine (step_device.hpp): what run_member() does on a thread, with the lists
// still made here.

#include <utility>

#include "engine/base/error.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

void StepLoop::use(std::unique_ptr<StepDevice> device) {
    GRAINREEL_CHECK(team_.size() == 1);  // one thread makes the lists
    device_ = std::move(device);
}

// The evaluations that follow, up to step `to`. Poses and kicks are known ahead: they depend on the lists'
// free flight, but not on the grains. `evaluations` is not moved.
std::vector<DeviceStep> StepLoop::steps_ahead(Evaluations evaluations, std::int64_t to, double step,
                                              KickInput kicks, bool begins_run) const {
    const ListLife& life = lists_.life();
    std::vector<DeviceStep> ahead;
    while (evaluations.step_number() < to && ahead.size() < device_->steps_ahead()) {
        const Evaluation at = evaluations.now();
        set_kicks(evaluations, at, step, kicks);
        DeviceStep& one = ahead.emplace_back();
        one.kicks = kicks;
        one.begins_run = begins_run;
        one.walls.set(around_, at.before, at.now, at.since);
        one.times = {at.since, scheme_.ahead, at.acts, at.since, 0, kicks.keep < 1};
        one.wall_way = life.wall_way(0, at, life.drift(at.time, step));
        evaluations.go_on();
        begins_run = false;
    }
    return ahead;
}

void StepLoop::run_on_device(std::int64_t from, std::int64_t to, double step, KickInput kicks) {
    // What a device does not compute.
    GRAINREEL_CHECK(!scheme_.corrects && grains_.orientation.empty() && around_.exits.empty() &&
                    around_.meshes.empty() && members_[0].walls.tally == nullptr);
    ThreadContacts& contacts = lists_.contacts(0);
    Evaluations evaluations(scheme_, around_.motion, step, from, first_step_);
    bool begins_run = true;
    device_->bring(rules_, grains_, contacts);
    while (evaluations.step_number() < to) {
        const std::vector<DeviceStep> ahead = steps_ahead(evaluations, to, step, kicks, begins_run);
        const DeviceRun done = device_->run(ahead, lists_.life().reach(0));
        for (std::size_t k = 0; k < done.told.size(); ++k) {
            const bool expired = done.expired && k + 1 == done.told.size();
            if (expired) device_->fetch(rules_, grains_, contacts);
            const std::int64_t refreshes = lists_.refreshes();
            lists_.renew(0, done.told[k].fastest, done.told[k].parted, evaluations.now(), step,
                         ahead[k].kicks.frame);
            GRAINREEL_CHECK((lists_.refreshes() != refreshes) == expired);
            if (expired) {
                device_->bring(rules_, grains_, contacts);
                device_->add_forces(ahead[k]);
            }
            kicks = ahead[k].kicks;
            evaluations.go_on();
            begins_run = false;
        }
    }
    device_->fetch(rules_, grains_, contacts);
    end_run(0, step, kicks);
    members_[0].reached = evaluations.step_number();
}

}  // namespace grainreel
