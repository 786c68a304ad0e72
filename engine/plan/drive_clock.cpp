#include "engine/plan/drive_clock.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/drive_schedule.hpp"

namespace grainreel {
namespace {

constexpr double dearest = 1.05;    // steps, over the fewest that would do
constexpr double rounding = 1e-12;  // relative: what is so close to whole steps is meant to be whole

bool is_whole(double value) {
    return std::abs(value - std::round(value)) <= rounding * std::max(1.0, value);
}

double snapped(double value) {
    return is_whole(value) ? std::round(value) : value;
}

bool all_fit(const Drive& drive, double eighths) {
    return std::all_of(drive.stages.begin(), drive.stages.end(), [&](const DriveStage& stage) {
        switch (stage.kind) {
            case DriveStage::Kind::vibrate:
                return is_whole(eighths * drive.frequency / stage.frequency);
            case DriveStage::Kind::taps:
                return is_whole(8 * eighths * drive.frequency * stage.interval);
            case DriveStage::Kind::rest:
                break;
        }
        return true;
    });
}

// The schedule's times in steps. Each stretch begins where the one before it ends, which loses nothing.
PeriodTable in_steps(const PeriodTable& times, double step) {
    PeriodTable table;
    for (const PeriodStretch& time : times.stretches()) {
        PeriodStretch stretch = time;
        stretch.period = snapped(time.period / step);
        stretch.period_after = snapped(time.period_after / step);
        stretch.start = 0;
        if (!table.empty()) {
            const PeriodStretch& before = table.stretches().back();
            stretch.start = snapped(before.start + before.time_after(stretch.cycles - before.cycles));
        }
        if (time.changes()) {
            const double cycles = std::round(time.cycles_after(time.length));
            stretch.length = length_of_change(cycles, stretch.period, stretch.period_after);
        }
        table.add(stretch);
    }
    return table;
}

}  // namespace

double common_eighths(const Drive& drive, double least) {
    const double fewest = std::max(least, std::ceil(drive.highest_frequency() / drive.frequency));
    for (double eighths = fewest; eighths <= dearest * fewest; ++eighths)
        if (all_fit(drive, eighths)) return eighths;
    return fewest;
}

Clock drive_clock(const Drive& drive, double step, std::int64_t steps_per_period) {
    Clock clock{step, steps_per_period, drive.phase};
    if (drive.changes()) clock.changes = in_steps(DriveSchedule(drive).times(), step);
    return clock;
}

}  // namespace grainreel
