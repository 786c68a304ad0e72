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
    double overlap[kChunk] = {};      // m, not above 0 where they do not touch
    double velocity[3][kChunk] = {};  // m/s, of i's surface against j's
    double twist[kChunk] = {};        // rad
    double first_arm[kChunk] = {}, second_arm[kChunk] = {};  // m, from the centres to where T acts
};

// What the law answers; zero where they do not touch.
struct alignas(64) ForceChunk {
    double normal[kChunk] = {};         // N, on j along k
    double tangential[3][kChunk] = {};  // N, on j
    double stored[kChunk] = {};         // J; set for observers only
};

}  // namespace grainreel
