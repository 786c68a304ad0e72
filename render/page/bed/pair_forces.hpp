// Who pushes whom, and how hard, at key moments: what the page draws as force chains.
//
// The bytes, before they are packed, are for each key moment of P pairs: low, middle and high bytes of the
// first grain's place in the list of grains, as its difference from the pair before (P each); likewise of the
// second grain's place, not as a difference, or 2^24 - 1 - face for a wall; P bytes of normal force, as
// speed_byte() of bed_frames.hpp has speeds. render/page/html/pair_forces.js reads them.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

struct PairForces {
    struct Moment {
        std::size_t moment = 0;  // of those that the page has
        std::size_t pairs = 0;
    };
    std::vector<Moment> moments;
    std::vector<std::uint8_t> packed;  // in zlib's format
    double lowest = 0, highest = 0;    // N, what the forces' bytes 1 and 254 stand for
};

class PairForcesWriter {
  public:
    // The next key moment. Pairs with a grain that the page lacks are left out. slots: of ids.
    void add(std::size_t moment, const std::vector<Touch>& touches,
             const std::map<std::int32_t, std::size_t>& slots);
    PairForces written() const;

  private:
    struct Pair {
        std::uint32_t first = 0, second = 0;
        double force = 0;  // N
    };
    std::vector<PairForces::Moment> moments_;
    std::vector<std::vector<Pair>> pairs_;
};

}  // namespace grainreel
