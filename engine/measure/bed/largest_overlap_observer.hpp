// How far bodies overlap at most.
#pragma once

#include <algorithm>

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class LargestOverlap final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"largest_overlap", "largest overlap / radius"}},
                 "1",
                 "largest overlap of a contact over the smaller radius (the plan's `run.overlap` is over the "
                 "diameter)"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const Moment&) override { largest_ = 0; }
    void contact(const Moment&, const ContactView& c) override {
        largest_ = std::max(largest_, c.overlap / c.smaller_radius);
    }
    void look(const Moment&, std::vector<double>& row) override { row.push_back(largest_); }

  private:
    double largest_ = 0;
};

}  // namespace grainreel::observers
