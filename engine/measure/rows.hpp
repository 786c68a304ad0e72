// When rows of measures.csv come, for observers that gather at them.
#pragma once

#include <cstdint>

#include "engine/plan/plan.hpp"
#include "engine/plan/times.hpp"

namespace grainreel {

class Rows {
  public:
    explicit Rows(const Plan& plan)
        : rhythm_(plan.measures_every, plan.measures_periods), clock_(plan.clock) {}

    // The first after this step, which is at least -1.
    std::int64_t after(std::int64_t step) const { return rhythm_.next(step + 1, clock_); }

  private:
    Rhythm rhythm_;
    Clock clock_;
};

}  // namespace grainreel
