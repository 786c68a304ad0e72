// After how many periods of the drive the bed repeats itself.
#pragma once

#include <cmath>

#include "engine/measure/bed/period_multiple.hpp"
#include "engine/measure/observer.hpp"
#include "engine/plan/rhythm.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel::observers {

class BedPeriods final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"bed_periods", "periods until the bed repeats itself"}},
                 "periods",
                 "of the drive, after which the bed repeats itself, as far as is known by then (see "
                 "[below](#beds-that-land-every-second-period)); 0 without a drive"},
                {{{"period_difference_m", "difference between periods", Dimension::length}},
                 "m",
                 "root mean square difference between the heights of the bed's centre of mass in a period "
                 "and in the one before; 0 until eight periods have been seen"}};
    }

    BedPeriods(const Scene& scene, const Plan& plan) : clock_(plan.clock), multiple_(mean_diameter(scene)) {}

    std::int64_t gathers_after(std::int64_t step) const override {
        return is_shaken() ? looks().next(step + 1, clock_) : kNever;
    }
    void start(const Moment& m) override {
        if (is_shaken() && looks().next(m.step, clock_) == m.step) gather(m);
    }
    void gather(const Moment& m) override {
        multiple_.add(std::llround(clock_.cycles(m.step) * PeriodMultiple::kPhases), centre_height(m));
    }
    void look(const Moment&, std::vector<double>& row) override {
        row.insert(row.end(),
                   {is_shaken() ? static_cast<double>(multiple_.value()) : 0.0, multiple_.difference()});
    }
    void save(std::ostream& out) const override { multiple_.save(out); }
    void load(const Moment&, Bytes& in) override { multiple_.load(in); }

  private:
    // m, of the centre of mass above the floor where that is now.
    static double centre_height(const Moment& m) {
        double moment = 0, mass = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            moment += m.grains.mass(i) * m.grains.place[i].position.z();
            mass += m.grains.mass(i);
        }
        return moment / mass - m.floor_height();
    }
    bool is_shaken() const { return clock_.steps_per_period > 0; }
    Rhythm looks() const {
        if (clock_.changes.empty())
            return Rhythm(static_cast<double>(clock_.steps_per_period / PeriodMultiple::kPhases));
        return Rhythm(0, 1.0 / PeriodMultiple::kPhases);
    }

    const Clock clock_;
    PeriodMultiple multiple_;
};

}  // namespace grainreel::observers
