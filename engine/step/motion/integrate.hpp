// Kicks (velocities by forces) and drifts (positions by velocities) of the grains, and the prediction and
// correction of Gear's method. scheme.hpp says in which order an integrator uses them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"

namespace grainreel {

// Marks the grains of a thread that have contacts. Only these can get a load before the lists are made again.
// The load of any other grain is zero and stays zero, so it is neither read nor cleared. So another thread
// can compute the flight of such a grain as well as its owner can.
//
// There is one bit for each grain, so that the bits of a million grains fit into the cache.
class Loaded {
  public:
    // The thread owns [begin, end), and none of these grains is marked.
    void clear(std::int32_t begin, std::int32_t end) {
        begin_ = begin, end_ = end, count_ = 0;
        words_.assign((end - begin) / 64 + 2, 0);
    }
    // Marks a grain. Grains of other threads are ignored.
    void note(std::int32_t grain) {
        if (grain < begin_ || grain >= end_) return;
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        const std::uint64_t bit = std::uint64_t{1} << at % 64;
        count_ += (words_[at / 64] & bit) == 0;
        words_[at / 64] |= bit;
    }
    bool has(std::int32_t grain) const { return from(grain) & 1; }
    // Whether so few grains are marked that it pays to treat the others apart: a quarter or less.
    bool few() const { return count_ <= (end_ - begin_) / 4; }
    // The bits of 64 grains from `grain` on, which must be one of the thread's own grains.
    std::uint64_t from(std::int32_t grain) const {
        const auto at = static_cast<std::uint32_t>(grain - begin_);
        return words_[at / 64] >> at % 64 | words_[at / 64 + 1] << 1 << (63 - at % 64);
    }

  private:
    std::int32_t begin_ = 0, end_ = 0, count_ = 0;
    std::vector<std::uint64_t> words_;
};

// Where drag acts, components of velocity (m/s) and spin (rad/s) below this count as zero. Otherwise they
// would fall until they are denormal numbers, for which a processor needs a hundred times as long.
constexpr double kNoMotion = 1e-60;

struct KickInput {
    Vec3 gravity{0, 0, 0};     // m/s2
    bool rubs = false;         // spins follow torques
    double keep = 1;           // share of velocity and spin that drag leaves after an ending kick
    Vec3 frame{0, 0, 0};       // m/s; speeds are measured and motion is rounded relative to this velocity
    double end_kick = 0;       // s, length of the kick that ends a step
    double begin_kick = 0;     // s, length of the kick that begins the next step, by the same forces
    double closing_drift = 0;  // s, length of the drift that ends a step, where the next one begins at once
    double drift = 0;          // s, length of the drift that begins a step
    const Loaded* loaded = nullptr;  // grains that may have a load; nullptr: all may
    bool unloaded = false;           // true: no grain has a load
};

// Loads are skipped where this many grains in a row have none. A branch for every single grain would be
// mispredicted.
constexpr int kTogether = 4;

// Begins a step of the grains [begin, end): a kick, then a drift. Sets the loads to zero. Returns the largest
// components (m/s) of the velocities relative to the frame.
Vec3 kick_and_drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Ends a step by the last kick. The loads stay.
void kick(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Ends one step and begins the next in one pass. The bits are the same as with kick() and kick_and_drift().
Vec3 kick_and_go_on(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Moves grains that have no load. Neither loads nor orientations nor speeds are needed for that.
struct FreeFlight {
    const KickInput& kicks;
    bool begins;  // true: as kick_and_drift() does; false: as kick_and_go_on() does
};
void fly(Grains& grains, const FreeFlight& flight, std::int32_t begin, std::int32_t end);

// A drift of the length `in.drift` without a kick. The loads stay.
void drift(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Turns the orientations of the grains, where they are in use, by their spins for `time` (s).
void turn(Grains& grains, const KickInput& in, double time, std::int32_t begin, std::int32_t end);

// Gear's method with four values for positions and three for spins. predict() goes to the end of `in.drift`
// and returns what kick_and_drift() returns. correct() then applies the new forces. begin_derivatives() sets
// the derivatives for the first prediction from the present forces.
void begin_derivatives(Grains& grains, const KickInput& in);
Vec3 predict(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);
void correct(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

// Sets Grains::rounded where it is in use. All functions that begin a step do this as well.
void round_motion(Grains& grains, const KickInput& in, std::int32_t begin, std::int32_t end);

}  // namespace grainreel
