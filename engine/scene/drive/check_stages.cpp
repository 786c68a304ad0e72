#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/drive/drive_schedule.hpp"
#include "engine/scene/drive/stage_keys.hpp"

namespace grainreel {
namespace {

constexpr double rounding = 1 + 1e-9;

[[noreturn]] void fail(const Scene& scene, std::size_t stage, const char* key, const std::string& what) {
    const std::string path = fmt::format("drive.stage[{}].{}", stage, key);
    throw UserError(fmt::format("{}: '{}' {}", scene.where(path), key, what));
}

void check_order(const Scene& scene) {
    const Drive& drive = scene.drive;
    for (std::size_t k = 0; k < drive.stages.size(); ++k) {
        const double from = drive.stages[k].from;
        if (k > 0 && !clearly_more(from, drive.stages[k - 1].from))
            fail(scene, k, "from",
                 fmt::format("is {:.6g} s, not later than the stage before it, {:.6g} s; stages follow each "
                             "other in time",
                             from, drive.stages[k - 1].from));
        if (!clearly_less(from, scene.run.duration))
            fail(scene, k, "from",
                 fmt::format("is {:.6g} s, but the run ends at {:.6g} s; bring it forward or lengthen "
                             "run.duration",
                             from, scene.run.duration));
    }
    const double grown = drive.ramp / drive.frequency, first = drive.stages.front().from;
    if (first > 0 && first * rounding < grown)
        fail(
            scene, 0, "from",
            fmt::format("is {:.6g} s, but until {:.6g} s the drive still grows (drive.ramp); begin later, or "
                        "at 0 in place of that drive",
                        first, grown));
}

// Each change must be over when the next stage begins, and each stage must have a tap or a period left.
void check_lengths(const Scene& scene) {
    const std::vector<DriveStage>& stages = scene.drive.stages;
    const DriveSchedule schedule(scene.drive);
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const bool last = k + 1 == stages.size();
        const double settled = schedule.settled(k + 1), end = last ? scene.run.duration : stages[k + 1].from;
        const std::string next = last ? "the run ends" : "the next stage begins";
        if (settled > end * rounding)
            fail(
                scene, k, "over",
                fmt::format("is {} periods, until {:.6g} s, but {} at {:.6g} s; change in fewer, or make the "
                            "stage longer",
                            stages[k].over, settled, next, end));
        if (stages[k].kind == DriveStage::Kind::taps && settled + 1 / stages[k].frequency > end * rounding)
            fail(scene, k, "interval",
                 fmt::format(
                     "has no time for a tap: the first would begin at {:.6g} s, and {} at {:.6g} s; make "
                     "the stage longer",
                     settled, next, end));
    }
}

// Whether the last stage has begun, and has a period or a tap left, when the run ends.
bool last_stage_counts(const Scene& scene) {
    const DriveStage& last = scene.drive.stages.back();
    const double end = scene.run.duration;
    if (last.from <= 0) return true;  // it is the drive
    if (!clearly_less(last.from, end)) return false;
    const double settled = DriveSchedule(scene.drive).settled(scene.drive.stages.size());
    const double tap = last.kind == DriveStage::Kind::taps ? 1 / last.frequency : 0;
    return settled + tap <= end * rounding;
}

}  // namespace

std::size_t shorten_stages(Scene& scene) {
    std::vector<DriveStage>& stages = scene.drive.stages;
    const std::size_t before = stages.size();
    const auto in_order = [](const DriveStage& a, const DriveStage& b) { return a.from <= b.from; };
    if (!std::is_sorted(stages.begin(), stages.end(), in_order)) return 0;  // and will be refused
    while (!stages.empty() && !last_stage_counts(scene)) stages.pop_back();
    return before - stages.size();
}

void check_stages(const Scene& scene) {
    if (!scene.drive.changes()) return;
    check_order(scene);
    check_lengths(scene);
}

}  // namespace grainreel
