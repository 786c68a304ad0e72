// When a shaken bed leaves the floor and when it lands.
#pragma once

#include <cstdint>
#include <optional>

namespace grainreel {

// Is told the force on the floor, over the bed's weight, as its means over stretches of steps that follow
// each other. The bed flies from the beginning of the first stretch in which the floor carries less than a
// tenth of the weight to the beginning of the first one in which it carries more than half; so a few grains
// that stay behind, or jump, neither end a flight nor make one. Flights shorter than a sixteenth of a period
// are the bed's own vibrations and do not count.
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

    // The stretch from step `from` to the one that the next call begins with.
    void add(std::int64_t from, double carried);

    // The last flight that has ended.
    std::optional<Times> last() const { return state_.any ? std::optional(state_.last) : std::nullopt; }

    // Everything it knows, for the checkpoint.
    struct State {
        bool flying = false;
        std::int64_t since = 0;  // step at which the present flight began
        Times last;
        bool any = false;  // whether there was a last one
    };
    const State& state() const { return state_; }
    void set(const State& state) { state_ = state; }

  private:
    const std::int64_t least_;  // steps
    State state_;
};

}  // namespace grainreel
