// The motion of a shaken bed: when it leaves the floor and lands (Flight), and after how many periods of the
// drive it repeats itself (PeriodMultiple). Observers of bed_observers.hpp feed both.
#pragma once

#include <cstdint>
#include <deque>
#include <iosfwd>
#include <optional>

#include "engine/base/binary.hpp"

namespace grainreel {

// Finds flights of the bed. Its input is the mean force on the floor, divided by the bed's weight, for one
// stretch of steps after the other. The bed flies from the beginning of the first stretch in which the floor
// carries less than a tenth of the weight to the beginning of the first one in which it carries more than
// half. So a few grains that stay behind, or jump, neither end a flight nor make one. Flights shorter than a
// sixteenth of a period are the bed's own vibrations and do not count.
//
// An inelastic block on a plate leaves it where the plate's acceleration is that of gravity, at the phase
// asin(1 / Gamma) / 2 pi of a sine.
class Flight {
  public:
    static constexpr double kLeaves = 0.1, kLands = 0.5;  // of the weight

    struct Times {
        std::int64_t from = 0, to = 0;  // steps
    };

    explicit Flight(std::int64_t period) : least_(period / 16) {}

    // Adds the stretch from step `from` to the first step of the next call.
    void add(std::int64_t from, double carried);

    // The last flight that has ended.
    std::optional<Times> last() const { return state_.any ? std::optional(state_.last) : std::nullopt; }

    // Everything it knows, for the checkpoint.
    struct State {
        bool flying = false;
        std::int64_t since = 0;  // step at which the present flight began
        Times last;
        bool any = false;  // whether a flight has ended
    };
    const State& state() const { return state_; }
    void set(const State& state) { state_ = state; }

  private:
    const std::int64_t least_;  // steps
    State state_;
};

// Finds after how many periods of the drive the bed repeats itself. A bed that is thrown so high that it
// lands only in every second period repeats itself after two. An inelastic block on a plate does so above
// sqrt(pi^2 + 4) g.
//
// It sees the height of the bed's centre of mass at the same phases of every period, and compares each period
// with the one before it, with the one before that, and so on.
class PeriodMultiple {
  public:
    static constexpr int kPhases = 8;   // moments in a period, evenly spaced
    static constexpr int kMost = 4;     // largest multiple that can be found, periods
    static constexpr int kWindow = 4;   // periods over which differences are taken
    static constexpr int kConfirm = 3;  // periods for which a first multiple must have held ...
    static constexpr int kChange =
        10;  // periods for which another multiple must have held, so that a short slip does not count

    // `diameter` (m) is that of a grain. Periods that differ by less than a tenth of it are equal.
    explicit PeriodMultiple(double diameter) : least_(0.1 * diameter) {}

    // Adds the height (m) above the floor at phase number `number`. The number counts on from period to
    // period and starts anywhere. After a gap everything begins anew.
    void add(std::int64_t number, double height);

    // Number of periods; 1 until another multiple is known.
    int value() const { return value_; }
    // Root mean square difference (m) between a period and the one before it.
    double difference() const { return difference_; }

    // Everything it knows, for the checkpoint.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    void end_period();
    double difference_to(int periods_before) const;
    int multiple_now() const;

    const double least_;          // m
    std::deque<double> heights_;  // m, heights of whole periods
    std::int64_t next_ = -1;      // next number that is expected
    int value_ = 1, other_ = 1, confirmed_ = 0;
    double difference_ = 0;
};

}  // namespace grainreel
