// Times that a plan counts in steps: when fields are measured (FieldTimes), events that come again and again
// (Rhythm), and the clock of a drive. A moment is a step at which fields are measured. A record is the mean
// of many moments, over whole periods of the drive or, without a drive, over an interval.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct FieldTimes {
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    // record, first and every are in ticks. A tick is a step; where a drive changes, a tick is the same part
    // of each period as a step is of the first period.
    std::int64_t record = 1;  // length of a record
    double first = 0;         // from step 0 to the first moment
    double every = 1;         // from moment to moment, not always whole: the nearest tick is taken
    std::int64_t end = 0;     // step at which the last record ends, which may be a shorter one
    std::int64_t phases = 1;  // number of moments until the drive's phase is that of the first again
    Clock clock = {};

    // The first moment, or end of a record, after `step`; kNever after the last one.
    std::int64_t next(std::int64_t step) const;
    bool is_moment(std::int64_t step) const;
    std::int64_t phase_of(std::int64_t moment) const;
    bool ends_record(std::int64_t step) const;
    // The first end of a record at or after `step`; kNever after the last one.
    std::int64_t next_end(std::int64_t step) const;
    // The step at which the record began that ends at step `end_of_it`.
    std::int64_t begin_of_record(std::int64_t end_of_it) const;

  private:
    std::int64_t tick_of(std::int64_t step) const;
    std::int64_t step_of(std::int64_t tick) const;
    std::int64_t number_of(std::int64_t step) const;  // number of the moment nearest to a step
    std::int64_t moment(std::int64_t number) const;
};

// Plans the moments for a run of so many steps.
FieldTimes field_times(const FieldOutput& fields, const Clock& clock, std::int64_t steps);

// Throws UserError when the fields that the scene asks for would not fit into memory.
void check_field_size(const Scene& scene);

// An event that comes again and again: every so many steps or, where a drive changes, every so many
// periods.

struct Rhythm {
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    double steps = 0;    // not always whole; 0: never, unless it goes by periods
    double periods = 0;  // 0: it goes by steps

    Rhythm(double every_steps, double every_periods = 0) : steps(every_steps), periods(every_periods) {}

    // The first step, from `step` (not negative) on, that is nearest to a multiple of `steps` or of
    // `periods`.
    std::int64_t next(std::int64_t step, const Clock& clock) const {
        if (periods > 0) {
            // The count begins one lower, so that rounding skips none.
            double count = std::max(0.0, std::floor(clock.cycles(step) / periods) - 1);
            while (clock.step_at(count * periods) < step) ++count;
            return clock.step_at(count * periods);
        }
        if (steps <= 0) return kNever;
        double count = std::floor(static_cast<double>(step) / steps);
        while (std::llround(count * steps) < step) ++count;
        return std::llround(count * steps);
    }
};

// The clock that goes with a drive: how many steps its periods have, throughout all stages.

// The number of steps in an eighth of a period at the drive's own frequency: `least` or somewhat more, and so
// many that an eighth of a period in the fastest stage has a step. It is the first number for which the
// periods of all stages are multiples of 8 steps, and intervals between taps are whole steps. If there is no
// such number within a few per cent, it is the smallest that is allowed; in some stages the eighths of a
// period then fall between steps.
double common_eighths(const Drive& drive, double least);

// step is in s, steps_per_period is of the drive's own frequency.
Clock drive_clock(const Drive& drive, double step, std::int64_t steps_per_period);

}  // namespace grainreel
