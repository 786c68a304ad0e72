// What the step loop shows of its contacts, and what it saves.
#include <algorithm>
#include <cmath>

#include "engine/base/binary.hpp"
#include "engine/step/forces/view_contacts.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

void StepLoop::visit_contacts(std::int64_t at_step,
                              const std::function<void(const ContactView&)>& visit) const {
    WallState walls;
    const Pose pose = around_.motion.at(at_step);
    walls.set(around_, pose, pose, 0);
    const ForceInput in{rules_, grains_, walls, around_.glued, around_.meshes, {}};
    std::vector<ContactView> late;
    const auto keep = [&](const ContactView& seen) { late.push_back(seen); };
    for (std::size_t g = 0; g < rules_.groups.size(); ++g) {
        late.clear();
        for (int m = 0; m < team_.size(); ++m) view_contacts(in, g, lists_.contacts(m), visit, keep);
        // Threads own stretches of the grains, so those in order are in order on any number of them.
        std::sort(late.begin(), late.end(), [](const ContactView& a, const ContactView& b) {
            if (a.first != b.first) return a.first < b.first;
            if (a.second != b.second) return a.second > b.second;
            return a.glued != b.glued ? a.glued < b.glued : a.triangle < b.triangle;
        });
        for (const ContactView& seen : late) visit(seen);
    }
}

void StepLoop::save(std::ostream& out) const {
    lists_.save(out);
    if (traffic_.any()) write_value(out, traffic_);
}

void StepLoop::load(Bytes& in, std::int64_t at_step) {
    lists_.load(in, around_.motion.at(at_step));
    if (!in.failed() && in.left() > 0) read_value(in, traffic_);
    if (in.failed() || !is_traffic_sound()) return in.fail();
    fresh_ = false;
}

bool StepLoop::is_traffic_sound() const {
    constexpr std::int64_t kMostIds = std::int64_t{1} << 31;
    const Traffic& t = traffic_;
    const auto known = [&](std::int32_t id) { return id < t.next_id; };
    return !t.any() || (t.came >= 0 && t.left >= 0 && t.openings >= 0 && std::isfinite(t.energy_in) &&
                        std::isfinite(t.energy_out) && std::isfinite(t.work_out) && t.next_id <= kMostIds &&
                        (t.came == 0 || std::all_of(grains_.id.begin(), grains_.id.end(), known)));
}

void StepLoop::take_histories(const HistoryOf& history_of) {
    constexpr std::int64_t kBefore = -1;  // walls stand as restart() had them
    lists_.take_histories(history_of);
    sum_loads_anew(std::vector<bool>(grains_.size(), true), kBefore);
}

}  // namespace grainreel
