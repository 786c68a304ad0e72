// When fields are looked at: a record is the mean of many moments, over whole periods of the drive.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct FieldTimes {
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

    // In ticks: a tick is a step, and of a drive that changes so large a part of each of its periods as a
    // step is of the first one.
    std::int64_t record = 1;  // of a record
    double first = 0;         // until the first moment
    double every = 1;         // from moment to moment, not always whole: the nearest tick is taken
    std::int64_t end = 0;     // step at which the last record ends, which may be a shorter one
    std::int64_t phases = 1;  // so many moments, and they are at the first one's phase again
    Clock clock = {};

    // The first moment, or end of a record, after `step`; kNever after the last one.
    std::int64_t next(std::int64_t step) const;
    bool is_moment(std::int64_t step) const;
    std::int64_t phase_of(std::int64_t moment) const;
    bool ends_record(std::int64_t step) const;
    // The first end of a record at or after `step`; kNever after the last one.
    std::int64_t next_end(std::int64_t step) const;
    // Where the record began that ends there.
    std::int64_t begin_of_record(std::int64_t end_of_it) const;

  private:
    std::int64_t tick_of(std::int64_t step) const;
    std::int64_t step_of(std::int64_t tick) const;
    std::int64_t number_of(std::int64_t step) const;  // of the moment nearest to a step
    std::int64_t moment(std::int64_t number) const;
};

// For a run of so many steps.
FieldTimes field_times(const FieldOutput& fields, const Clock& clock, std::int64_t steps);

// Throws UserError when the fields that the scene asks for would not fit into memory.
void check_field_size(const Scene& scene);

}  // namespace grainreel
