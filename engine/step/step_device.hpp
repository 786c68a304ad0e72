// Another machine that computes the steps of a StepLoop: a graphics card (engine/card). The loop says what
// each evaluation of forces needs, and makes the lists; the device holds grains and contacts meanwhile. It
// sums in the order of the loop, so its bits are those of the processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"
#include "engine/step/forces/law_input.hpp"
#include "engine/step/geometry/walls.hpp"
#include "engine/step/lists/contact_rules.hpp"
#include "engine/step/lists/list_life.hpp"
#include "engine/step/lists/thread_contacts.hpp"
#include "engine/step/motion/integrate.hpp"

namespace grainreel {

// One evaluation of forces, with the motion that leads to it.
struct DeviceStep {
    KickInput kicks;
    bool begins_run;   // no step ends before it
    WallState walls;   // at the forces
    ForceTimes times;  // of the forces
    double wall_way;   // m, how far walls have moved since the contact lists were refreshed
};

// What an evaluation told about the lists; see ListLife::contacts_expired().
struct DeviceTold {
    Vec3 fastest{0, 0, 0};
    std::int64_t parted = 0;
};

struct DeviceRun {
    std::vector<DeviceTold> told;
    bool expired = false;  // in the last evaluation that told something
};

class StepDevice {
  public:
    StepDevice() = default;
    StepDevice(const StepDevice&) = delete;
    StepDevice& operator=(const StepDevice&) = delete;
    virtual ~StepDevice() = default;

    // How many evaluations it likes to get at once.
    virtual std::size_t steps_ahead() const = 0;
    // Takes grains and contacts as they are now.
    virtual void bring(const ContactRules& rules, const Grains& grains, const ThreadContacts& contacts) = 0;
    // Makes evaluations until the contact lists expire, as expiry.hpp says for `reach`. Where they do, the
    // grains have moved, but have no forces yet; that evaluation told something too.
    virtual DeviceRun run(const std::vector<DeviceStep>& steps, const Reach& reach) = 0;
    // Computes the forces of an evaluation whose grains have moved.
    virtual void add_forces(const DeviceStep& step) = 0;
    // Gives grains and contacts back.
    virtual void fetch(const ContactRules& rules, Grains& grains, ThreadContacts& contacts) = 0;
};

}  // namespace grainreel
