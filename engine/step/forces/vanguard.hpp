// Grains that begin their next step while other grains still wait for forces.
//
// These grains are still in the cache, so the bed passes through memory once a step, not twice. No contact
// that is still to be computed may need such a grain, and no other thread may read it.
//
// What this gains: a rising bed of a million grains is some 1.07 times as fast, and a bed of 10,000 grains on
// two threads 1.02 to 1.03 times. A bed on one thread that fits into the cache gains nothing and would take
// up to 1.6 % more instructions, so its grains do not go ahead (docs/notes/performance.md, "Three devices of
// the step").
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/step/motion/integrate.hpp"

namespace grainreel {

struct Vanguard {
    std::int32_t next = 0,
                 end = 0;  // the grains [next, end) may begin their next step; none of an empty range
    KickInput kicks;
    Vec3 fastest{0, 0, 0};  // m/s, largest components of the velocities of those that have begun it
};

// Lets the grains below `complete` begin their next step. Up to kTogether - 1 of them stay back, so that
// grains are always taken kTogether at a time.
inline void advance(Vanguard& vanguard, Grains& grains, std::int32_t complete) {
    const std::int32_t many = complete - vanguard.next;
    const std::int32_t end = std::min(vanguard.next + many - many % kTogether, vanguard.end);
    if (end <= vanguard.next) return;
    vanguard.fastest = vanguard.fastest.cwiseMax(kick_and_go_on(grains, vanguard.kicks, vanguard.next, end));
    vanguard.next = end;
}

}  // namespace grainreel
