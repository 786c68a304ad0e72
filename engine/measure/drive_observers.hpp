// Observers of the drive: the time of a row, the drive's frequency and acceleration, and the place of the
// floor.
#pragma once

#include "engine/base/numbers.hpp"
#include "engine/measure/observer.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel::observers {

// Observer of step, time, phase and periods of the drive.
class Times final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"step", "step"}, {"time_s", "time", Dimension::time}}, "1, s", "since the drive started"},
                {{{"phase_turns", "phase (turns)"}},
                 "turns, 0 to 1",
                 "the drive's phase, `drive.phase` included; 0 without a drive"},
                {{{"cycles", "periods"}}, "periods", "since the drive started; 0 without a drive"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.insert(row.end(), {static_cast<double>(m.step), m.clock.time(m.step), m.clock.phase(m.step),
                               m.clock.cycles(m.step)});
    }
};

// Observer of the drive's present stage. It gives the frequency f and Gamma = a (2 pi f)^2 / g; during a
// change and the ramp these are the values of that instant.
class DriveNow final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"drive_frequency_Hz", "drive frequency", Dimension::frequency}},
                 "Hz",
                 "of the stage that is on, of a tap 1 over how long it lasts; 0 at rest and without a drive"},
                {{{"drive_g_level", "Γ of the drive"}},
                 "1",
                 "of the stage that is on, of the moment while the drive grows; 0 at rest and without a "
                 "drive, NaN without gravity"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        const Drive& drive = m.scene.drive;
        double frequency = 0, g_level = 0;
        const double cycles = m.clock.cycles(m.step);
        const DriveSchedule::Now now = drive_now(drive, cycles);
        if (drive.present && now.kind != DriveStage::Kind::rest) {
            frequency = now.frequency;
            const double amplitude = grown_share(drive, cycles) * now.amplitude;
            g_level = Drive{true, now.frequency, amplitude}.g_level(m.gravity.norm());
            if (m.gravity.isZero(0)) g_level = kUnknown;
        }
        row.insert(row.end(), {frequency, g_level});
    }
};

// Observer of the displacement of the drive.
class FloorPosition final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"floor_position_m", "floor position", Dimension::length}},
                 "m",
                 "displacement of what the drive moves, along `drive.direction`"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.push_back(m.pose.offset.dot(m.scene.drive.direction));
    }
};

}  // namespace grainreel::observers
