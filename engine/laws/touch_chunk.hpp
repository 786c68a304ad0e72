// Contacts on their way through a law, a chunk at a time. A chunk is small enough for the first-level cache,
// and laid out so that a register takes several contacts at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "engine/base/processor.hpp"

namespace grainreel {

constexpr int kBlock = 16;  // histories are kept in blocks of 16 contacts
constexpr int kChunk = 64;  // contacts in a chunk

// The bits of a chunk's first `count` contacts.
inline std::uint64_t bits_of_first(int count) {
    return count < kChunk ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

// One number of each contact of a chunk: doubles, or floats on the way through a law of mixed precision.
union alignas(64) Row {
    double doubles[kChunk] = {};
    float floats[kChunk];

    template <class Number>
    Number* of() {
        if constexpr (std::is_same_v<Number, float>)
            return floats;
        else
            return doubles;
    }
    template <class Number>
    const Number* of() const {
        return const_cast<Row*>(this)->of<Number>();
    }
    double operator[](int c) const { return doubles[c]; }  // for observers, who get doubles
    // Gives one number, whether the row holds doubles or floats of `number_size` bytes.
    double get(int c, std::size_t number_size) const {
        return number_size == sizeof(float) ? floats[c] : doubles[c];
    }
    void set(int c, double value, std::size_t number_size) {
        if (number_size == sizeof(float))
            floats[c] = static_cast<float>(value);
        else
            doubles[c] = value;
    }
};

// Geometry and motion of each contact; see Touch for the meaning. Only the rows that the law asks for are
// set.
struct TouchChunk {
    Row normal[3];
    Row overlap;                 // m
    Row velocity[3];             // m/s, of i's surface against j's
    Row turn[3];                 // Cayley's vector: a pure number
    Row first_arm, second_arm;   // m, from the centres to where T acts
    Row inverse_distance;        // 1/m, of the centres of a pair
    Row inverse_mass;            // 1/kg, of the effective mass
    Row effective_radius;        // m
    std::uint64_t touching = 0;  // one bit for each contact: overlap > 0
    Ahead* ahead = nullptr;      // data to fetch while the chunk is worked on

    bool touches(int c) const { return touching >> c & 1; }
    [[gnu::always_inline]] inline void fetch_some() const {
        if (ahead) ahead->fetch_some();
    }
    // Whether any of `count` contacts from c on touches.
    bool any_touching(int c, int count) const {
        return (touching >> c & ((std::uint64_t{2} << (count - 1)) - 1)) != 0;
    }
};
static_assert(kChunk == 64, "a bit for each contact");

// The forces that the law computes; zero for contacts that do not touch.
struct ForceChunk {
    Row normal;         // N, on j along k
    Row tangential[3];  // N, on j
};

// Energies and powers of each contact for observers; see Energies for the meaning.
struct alignas(64) EnergyChunk {
    double stored[kChunk] = {}, sideways[kChunk] = {}, latched[kChunk] = {};  // J
    double damping[kChunk] = {}, rubbing[kChunk] = {};                        // W
};

// The motion of contacts that resist rolling, and the resulting torque.
struct RollingChunk {
    Row rate[3];    // rad/s, spin of i against j, across k
    Row torque[3];  // N m, on j, the opposite on i
};

}  // namespace grainreel
