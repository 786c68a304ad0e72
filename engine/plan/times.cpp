#include "engine/plan/times.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {

namespace {

constexpr double most_bytes = 2e9;  // of memory for the sums of fields; each phase of the drive has sums of
                                    // its own

}  // namespace

std::int64_t FieldTimes::tick_of(std::int64_t step) const {
    if (clock.changes.empty()) return step;
    return std::llround(clock.cycles(step) * static_cast<double>(clock.steps_per_period));
}

std::int64_t FieldTimes::step_of(std::int64_t tick) const {
    if (clock.changes.empty()) return tick;
    return clock.step_at(static_cast<double>(tick) / static_cast<double>(clock.steps_per_period));
}

std::int64_t FieldTimes::number_of(std::int64_t step) const {
    return std::llround((static_cast<double>(tick_of(step)) - first) / every);
}

std::int64_t FieldTimes::moment(std::int64_t number) const {
    return step_of(std::llround(first + static_cast<double>(number) * every));
}

bool FieldTimes::is_moment(std::int64_t step) const {
    const std::int64_t number = number_of(step);
    return step < end && number >= 0 && moment(number) == step;
}

std::int64_t FieldTimes::phase_of(std::int64_t moment) const {
    return number_of(moment) % phases;
}

bool FieldTimes::ends_record(std::int64_t step) const {
    return step > 0 && next_end(step) == step;
}

std::int64_t FieldTimes::next_end(std::int64_t step) const {
    if (step > end || end == 0) return kNever;
    const std::int64_t from = std::max<std::int64_t>(step, 1);
    std::int64_t count = std::max<std::int64_t>(1, tick_of(from) / record);
    while (step_of(count * record) < from) ++count;
    return std::min(step_of(count * record), end);
}

std::int64_t FieldTimes::begin_of_record(std::int64_t end_of_it) const {
    return step_of((tick_of(end_of_it) - 1) / record * record);
}

std::int64_t FieldTimes::next(std::int64_t step) const {
    if (step >= end) return kNever;
    std::int64_t number = std::max<std::int64_t>(0, number_of(step));
    while (moment(number) <= step) ++number;
    return std::min(moment(number), next_end(step + 1));
}

FieldTimes field_times(const FieldOutput& fields, const Clock& clock, std::int64_t steps) {
    FieldTimes times;
    times.clock = clock;
    const std::int64_t period = clock.steps_per_period;
    if (period == 0) {
        times.record = std::max<std::int64_t>(1, std::llround(fields.interval / clock.step));
        times.end = steps / times.record * times.record;
        const std::int64_t samples = std::min<std::int64_t>(fields.samples, times.record);
        times.every = static_cast<double>(times.record) / static_cast<double>(samples);
        return times;
    }
    times.record = fields.periods * period;
    times.end =
        clock.changes.empty() ? steps / period * period : clock.step_at(std::floor(clock.cycles(steps)));
    times.phases = fields.phase ? 1 : std::min<std::int64_t>(fields.samples, period);
    times.every = static_cast<double>(period) / static_cast<double>(times.phases);
    if (!fields.phase) return times;
    const double turns = *fields.phase - clock.initial_phase;
    const std::int64_t offset = std::llround((turns - std::floor(turns)) * static_cast<double>(period));
    times.first = static_cast<double>(offset % period);
    return times;
}

void check_field_size(const Scene& scene) {
    const FieldOutput& fields = scene.output.fields;
    if (!fields.wanted()) return;
    const Vec3 size = extent_of(scene).size();
    const bool in_depth = fields.grid == FieldOutput::Grid::xyz;
    double cells = 1;
    for (int k = in_depth ? 0 : 1; k < 3; ++k) cells *= std::ceil(size[k] / fields.cell) + 10;
    const double phases = fields.phase || !scene.drive.present ? 1 : fields.samples;
    const double bytes = cells * 8 * (10 * phases + 10 + static_cast<double>(scene.species.size()));
    if (bytes <= most_bytes) return;
    throw UserError(
        "{}: fields on {:.3g} cells at {:g} phases take {:.3g} GB of memory, and the most are "
        "{:g} GB; raise output.fields.cell or lower output.fields.samples",
        scene.where("output.fields.cell"), cells, phases, bytes / 1e9, most_bytes / 1e9);
}

namespace {

constexpr double dearest = 1.05;    // number of steps divided by the fewest that would do
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

// Turns the schedule's times into steps. Each stretch begins where the one before it ends, so no time is
// lost.
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
