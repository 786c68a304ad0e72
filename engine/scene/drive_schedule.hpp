// What the drive does at which time: its stages one after the other, and the changes between them.
//
// A stage begins with the first period that starts at its `from` or later, and the change to it takes whole
// periods. So each stretch of time begins at the phase that the drive has at the start of the run
// (drive.phase), and the count of periods has no jump. With taps, a period lasts from one tap to the next; at
// rest, the periods of the stage before go on.
#pragma once

#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The change from one vibration to another: frequency and acceleration go smoothly from one value to the
// other. With u = time since the start over `duration`, from 0 to 1, and s(u) = smooth_step::value(u):
//   f = f0 + (f1 - f0) s,   A = A0 + (A1 - A0) s,   a = A / (2 pi f)^2,   z = a sin(2 pi integral of f dt).
// Place, velocity and acceleration are continuous at both ends.
struct DriveChange {
    double frequency_before = 0, frequency = 0;        // Hz, positive
    double acceleration_before = 0, acceleration = 0;  // m/s2: amplitude of the acceleration, a (2 pi f)^2
    double duration = 0;                               // s

    // Angular frequency and amplitude at u, and their rates of change.
    struct Values {
        double omega, omega_rate;                           // 1/s, 1/s2
        double amplitude, amplitude_rate, amplitude_rate2;  // m, m/s, m/s2
    };
    Values at(double u) const;
};

// The largest displacement (m), velocity (m/s) and acceleration (m/s2) of a sine with these values, at any
// phase.
struct Envelope {
    double offset, speed, acceleration;
};
Envelope envelope_of(const DriveChange::Values& values);

class DriveSchedule {
  public:
    // The drive must oscillate, and its stages must have passed check_stages().
    explicit DriveSchedule(const Drive& drive);

    // What the drive does in each stretch of times().
    struct Piece {
        std::size_t stage = 0;  // the stage that holds or begins, from 1; 0: the drive before the first stage
        DriveStage::Kind kind = DriveStage::Kind::vibrate;  // what the stretch does; a change vibrates
        double frequency_before = 0, frequency = 0;         // Hz, of the vibration or of a tap
        double acceleration_before = 0, acceleration = 0;   // m/s2, a (2 pi f)^2
        double interval = 0;                                // s, between taps
    };
    const PeriodTable& times() const { return times_; }  // s
    const std::vector<Piece>& pieces() const { return pieces_; }
    DriveChange change(std::size_t piece) const;

    // Time (s) when the change to a stage begins, and when it is over; stages count from 1.
    double begins(std::size_t stage) const;
    double settled(std::size_t stage) const;

    // What the drive does after so many periods. During a change it has the values of that instant.
    struct Now {
        std::size_t stage = 0;
        DriveStage::Kind kind = DriveStage::Kind::vibrate;
        bool changing = false;
        double frequency = 0, amplitude = 0;  // Hz, m
        double interval = 0;                  // s, between taps
    };
    Now now(double cycles) const;

  private:
    void begin(std::size_t stage, const DriveStage& next);
    void add(const PeriodStretch& stretch, const Piece& piece);

    PeriodTable times_;
    std::vector<Piece> pieces_;
};

// What a drive, with stages or without, does after so many periods.
DriveSchedule::Now drive_now(const Drive& drive, double cycles);

// The largest values that the drive reaches in all its stages, changes included.
struct DrivePeaks {
    double frequency = 0;     // Hz, of vibrations and taps
    double offset = 0;        // m, from rest; a tap's is twice its amplitude
    double speed = 0;         // m/s
    double acceleration = 0;  // m/s2
};
DrivePeaks drive_peaks(const Drive& drive);
// Largest acceleration (m/s2) in the change to a stage; 0 if nothing has to change.
double peak_acceleration_of_change(const DriveSchedule& schedule, std::size_t stage);

// The share of its amplitude that a drive has after so many periods: 0 before the start, growing during the
// ramp, and 1 from the first stage on.
inline double grown_share(const Drive& drive, double cycles) {
    if (cycles < 0) return 0;
    if (cycles >= drive.ramp || drive_now(drive, cycles).stage > 0) return 1;
    return smooth_step::value(cycles / drive.ramp);
}

}  // namespace grainreel
