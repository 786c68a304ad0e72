// When: step, time, phase and periods of the drive.
#pragma once

#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class Times final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"step", "step"}, {"time_s", "time", Dimension::time}}, "1, s", "since the drive started"},
                {{{"phase_turns", "phase (turns)"}},
                 "turns, 0 to 1",
                 "the drive's phase, `drive.phase` included; 0 without a drive"},
                {{{"cycles", "periods"}}, "periods", "since the drive started; 0 without a drive"}};
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.insert(row.end(), {static_cast<double>(m.step), m.clock.time(m.step), m.clock.phase(m.step),
                               m.clock.cycles(m.step)});
    }
};

}  // namespace grainreel::observers
