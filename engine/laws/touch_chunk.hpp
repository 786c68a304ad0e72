// Contacts on their way through a law, a chunk at a time: small enough for the first-level cache, laid out so
// that a register takes several at once.
#pragma once

#include <cstdint>

namespace grainreel {

constexpr int kBlock = 8;   // histories are kept in blocks of 8 contacts
constexpr int kChunk = 64;  // contacts

// What geometry and motion say of each contact; see Touch for the meaning. Only what the law asks for is set.
struct alignas(64) TouchChunk {
    double normal[3][kChunk] = {};
    double overlap[kChunk] = {};                             // m
    double velocity[3][kChunk] = {};                         // m/s, of i's surface against j's
    double twist[kChunk] = {};                               // rad
    double first_arm[kChunk] = {}, second_arm[kChunk] = {};  // m, from the centres to where T acts
    double inverse_distance[kChunk] = {};                    // 1/m, of the centres of a pair
    double effective_mass[kChunk] = {};                      // kg
    double effective_radius[kChunk] = {};                    // m
    std::uint64_t touching = 0;  // a bit a contact: overlap > 0. Last: it would shift the arrays

    // Of `count` contacts from c on.
    bool any_touching(int c, int count) const {
        return (touching >> c & ((std::uint64_t{2} << (count - 1)) - 1)) != 0;
    }
};
static_assert(kChunk == 64, "a bit for each contact");

// What the law answers; zero where they do not touch.
struct alignas(64) ForceChunk {
    double normal[kChunk] = {};         // N, on j along k
    double tangential[3][kChunk] = {};  // N, on j
};

// What observers are told of each contact's energy; see Energies for the meaning.
struct alignas(64) EnergyChunk {
    double stored[kChunk] = {}, sideways[kChunk] = {}, latched[kChunk] = {};  // J
    double damping[kChunk] = {}, rubbing[kChunk] = {};                        // W
};

// Of contacts that resist rolling: their motion, and the answer.
struct alignas(64) RollingChunk {
    double rate[3][kChunk] = {};    // rad/s, spin of i against j, across k
    double torque[3][kChunk] = {};  // N m, on j, the opposite on i
};

}  // namespace grainreel
