// Measures where a thread's time goes. It is off unless someone asks for it. It then reads the processor's
// counter several times for each chunk of contacts.
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/processor.hpp"

namespace grainreel {

// neighbours: lists and cells. contacts: geometry and laws of pairs. gather: their forces into the grains'
// loads. walls: all of that for walls. integrate: kicks and drifts. other: waiting for threads, and the rest.
enum class Cost { neighbours, contacts, walls, gather, integrate, other };
constexpr int kCosts = 6;

class CostClock {
  public:
    // Counts from nothing.
    void clear() { spent_.fill(0); }
    void turn(bool on) { on_ = on; }
    void start() {
        if (on_) last_ = ticks();
    }
    // The time since start() or the last lap() went into `cost`.
    void lap(Cost cost) {
        if (!on_) return;
        const std::uint64_t now = ticks();
        spent_[static_cast<int>(cost)] += static_cast<double>(now - last_);
        last_ = now;
    }
    const std::array<double, kCosts>& spent() const { return spent_; }  // ticks; their length is not known

  private:
    bool on_ = false;
    std::uint64_t last_ = 0;
    std::array<double, kCosts> spent_{};
};

}  // namespace grainreel
