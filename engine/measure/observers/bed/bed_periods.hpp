// After how many periods of the drive the bed repeats itself.
#pragma once

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

// As long as nobody has looked at whole periods (PeriodMultiple): 1. Who has sets the column.
class BedPeriods final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"bed_periods", "periods until the bed repeats itself"}},
                 "periods",
                 "of the drive, after which the bed repeats itself, as far as is known by then (see "
                 "[below](#beds-that-land-every-second-period)); 0 without a drive"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.push_back(m.clock.steps_per_period > 0 ? 1 : 0);
    }
};

}  // namespace grainreel::observers
