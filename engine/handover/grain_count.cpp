#include "engine/handover/grain_count.hpp"

#include <algorithm>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"

namespace grainreel {

namespace {

constexpr double kSlack = 1.5;  // factor on the way in free fall, because other grains may push

}  // namespace

// Whether the grain can reach an exit in that time. Other grains push it, but not far.
bool GrainCount::may_leave(const State& before, std::size_t row, double seconds) const {
    const Vec3& at = before.position[row];
    const double way = before.velocity[row].norm() * seconds + scene_.gravity.norm() * seconds * seconds / 2;
    const double reach = kSlack * way + 4 * before.radius[row];
    const Container& container = scene_.container;
    if (container.outlet && !container.tray && at.z() + container.outlet->exit_depth <= reach) return true;
    for (const ExitBox& exit : scene_.exits) {
        const double inside = std::min((at - exit.low).minCoeff(), (exit.high - at).minCoeff());
        const double outside = (exit.low - at).cwiseMax(at - exit.high).cwiseMax(0).norm();
        if (exit.outside ? inside <= reach : outside <= reach) return true;
    }
    return false;
}

GrainCount::Change GrainCount::compare(const State* before, const State& now) const {
    Change change;
    if (before == nullptr) {
        const std::int64_t wanted = scene_.grains_at_start();
        if (static_cast<std::int64_t>(now.size()) < wanted)
            throw RunError("{}: step {}: has {}, but the scene begins with {}", file_, now.step,
                           counted(now.size(), "grain"), wanted);
        if (static_cast<std::int64_t>(now.size()) > wanted && scene_.feeds.empty())
            throw RunError(
                "{}: step {}: has {}, but the scene begins with {} and feeds none; is it "
                "the dump of another run?",
                file_, now.step, counted(now.size(), "grain"), wanted);
        return change;
    }
    std::size_t k = 0;
    for (std::size_t i = 0; i < before->size(); ++i) {
        while (k < now.size() && now.id[k] < before->id[i]) ++k, ++change.came;
        if (k < now.size() && now.id[k] == before->id[i]) {
            ++k;
            continue;
        }
        if (!may_leave(*before, i, now.time - before->time)) {
            const Vec3& at = before->position[i];
            throw RunError(
                "{}: step {}: grain {} is missing; it was last at ({:.4g}, {:.4g}, {:.4g}) m "
                "in step {}, where it could not leave: it broke through a wall, which is "
                "too soft for its speed, or left the box of the run",
                file_, now.step, before->id[i], at.x(), at.y(), at.z(), before->step);
        }
        change.left.push_back(i);
    }
    change.came += static_cast<std::int64_t>(now.size() - k);
    if (change.came > 0 && scene_.feeds.empty())
        throw RunError(
            "{}: step {}: has {} grains that the frame before lacks, and the scene feeds "
            "none; is it the dump of another run?",
            file_, now.step, change.came);
    return change;
}

}  // namespace grainreel
