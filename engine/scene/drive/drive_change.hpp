// How a vibration turns into another one: frequency and acceleration go smoothly from one value to the other.
#pragma once

namespace grainreel {

// u = time since the start over `duration`, from 0 to 1, and s(u) as in smooth_step.hpp:
//   f = f0 + (f1 - f0) s,   A = A0 + (A1 - A0) s,   a = A / (2 pi f)^2,   z = a sin(2 pi integral of f dt).
// Place, velocity and acceleration are continuous at both ends.
struct DriveChange {
    double frequency_before = 0, frequency = 0;        // Hz, positive
    double acceleration_before = 0, acceleration = 0;  // m/s2: amplitude of the acceleration, a (2 pi f)^2
    double duration = 0;                               // s

    // The sine's values and their rates at u.
    struct Values {
        double omega, omega_rate;                           // 1/s, 1/s2
        double amplitude, amplitude_rate, amplitude_rate2;  // m, m/s, m/s2
    };
    Values at(double u) const;
};

// The largest that place, velocity and acceleration can be for any phase of a sine with these values: m, m/s,
// m/s2.
struct Envelope {
    double offset, speed, acceleration;
};
Envelope envelope_of(const DriveChange::Values& values);

}  // namespace grainreel
