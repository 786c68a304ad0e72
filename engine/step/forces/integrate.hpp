// Kicks and drifts of the grains, and Gear's prediction and correction. Which follow on which: scheme.hpp.
#pragma once

#include <cstdint>

#include "engine/state/grains.hpp"
#include "engine/step/forces/loaded.hpp"

namespace grainreel {

struct KickInput {
    Vec3 gravity{0, 0, 0};           // m/s2
    bool rubs = false;               // spins follow torques
    double keep = 1;                 // share of velocity and spin that drag leaves after an ending kick
    Vec3 frame{0, 0, 0};             // m/s, velocity against which speeds are measured and motion is rounded
    double end_kick = 0;             // s, by the forces of now
    double begin_kick = 0;           // s, by the same forces once more
    double drift = 0;                // s
    const Loaded* loaded = nullptr;  // the loads of its other grains are left alone; nullptr: of none
    bool unloaded = false;           // no grain has a load
};

// Loads are left alone where so many grains in a row have none: grain by grain, a processor could not predict
// it.
constexpr int kTogether = 4;

// Begins: kick and drift of the grains [begin, end); loads are used up and set to zero. Returns the largest
// components (m/s) of their velocities against the frame.
Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Ends: v and w after the last kick. Loads stay.
void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// An end and a beginning at once, the same bits as one after the other.
Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// What moves a step's grains, for those that have no load: theirs is not looked at, nor how they stand, nor
// how fast they are.
struct Flight {
    const KickInput& kicks;
    bool begins;  // kick_and_drift(), or kick_and_go_on()
};
void fly(Grains& grains, const Flight& flight, std::int32_t begin, std::int32_t end);

// A stretch of grains that begin their next step while others still wait for forces: while they are in the
// cache, which saves a second way through memory. Nobody may need them as they were: no contact that is yet
// to be computed, and no other thread.
struct Vanguard {
    std::int32_t begin = 0, end = 0;  // empty: none
    KickInput kicks;
    std::int32_t next = 0;  // [begin, next) have gone on
    Vec3 fastest{0, 0, 0};  // m/s, of these
};
// All of them below `complete`, but for a few, so that the others can be taken together.
void advance(Vanguard& vanguard, Grains& grains, std::int32_t complete);

// A drift alone. Loads stay.
void drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Gear's four values (position) and three (spin): to the end of `in.drift`, as kick_and_drift; then what the
// new forces say of it. The first prediction takes the forces of now.
void begin_derivatives(Grains& grains, const KickInput& in);
Vec3 predict(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);
void correct(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Sets Grains::rounded, as all that begin a step do where there is any.
void round_motion(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

}  // namespace grainreel
