// Named streams of random numbers, the same on every machine. Drawing from one stream never changes another.
// The number of each stream is part of its seed and must not change, because runs would change with it.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <random>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/base/vector.hpp"

namespace grainreel {

enum class Stream : std::uint64_t {
    diameters = 1,
    centres = 2,
    velocities = 3,
    rain_species = 4,
    rain_places = 5,
    feed_sizes = 6,   // one part for each feed and grain
    feed_places = 7,  // one part for each feed, grain and step
    wall_grains = 8
};

class Random {
  public:
    Random(std::uint64_t seed, Stream stream) {
        std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                          static_cast<std::uint32_t>(stream)};
        engine_.seed(mix);
    }

    // One part of the stream, named by numbers. It does not depend on what was drawn from other parts.
    Random(std::uint64_t seed, Stream stream, std::initializer_list<std::int64_t> part) {
        std::vector<std::uint32_t> words;
        const auto add = [&](std::uint64_t number) {
            words.push_back(static_cast<std::uint32_t>(number));
            words.push_back(static_cast<std::uint32_t>(number >> 32));
        };
        add(seed), add(static_cast<std::uint64_t>(stream));
        for (const std::int64_t number : part) add(static_cast<std::uint64_t>(number));
        std::seed_seq mix(words.begin(), words.end());
        engine_.seed(mix);
    }

    // A number in [0, 1) with 53 bits. std::uniform_real_distribution would differ between libraries.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    // A vector with each part between -reach and reach. C++ leaves open in which order arguments are
    // evaluated; here z is drawn first and x last, as GCC did when the first packings were made.
    Vec3 in_cube(double reach) {
        const double z = between(-reach, reach);
        const double y = between(-reach, reach);
        return {between(-reach, reach), y, z};
    }
    // A normal number with mean 0 and standard deviation 1 (Box & Muller 1958).
    double normal() {
        const double u = 1 - uniform(), v = uniform();
        return std::sqrt(-2 * math::log(u)) * math::cos(2 * std::numbers::pi * v);
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace grainreel
