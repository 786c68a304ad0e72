// A scene that a test hands over, and the engine that runs it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>

#include "engine/handover/carry.hpp"
#include "engine/handover/deck_dump.hpp"
#include "engine/handover/peer_process.hpp"

namespace grainreel {

// For the names of tests.
inline void PrintTo(PeerEngine engine, std::ostream* out) {
    *out << key_of(engine);
}

}  // namespace grainreel

namespace grainreel::test {

// Whether the engine and mpirun are installed; ./test --peers installs them.
bool has_engine(PeerEngine engine);

// The text of a scene with 60 balls in a box. more: what it has beside these, from the container's last keys
// on.
std::string balls_in_box(double restitution, double friction, const std::string& more);

// Writes deck, data and walls of a scene into the folder. Throws UserError for a scene that is not carried.
CarriedScene hand_over(const std::string& text, const CarryRequest& request,
                       const std::filesystem::path& folder);

// Runs the engine there until it ends, and returns what it complained of, or nothing.
std::string run_engine(PeerProcess job, const std::filesystem::path& folder);

// All frames of the dump in the folder, by the engine's step.
std::map<std::int64_t, State> frames_of(PeerEngine engine, const std::filesystem::path& folder);

// For tests and their SetUp(): skips where the engine is missing. Under `./test --peers`, which is for these
// tests and installs the engines, that is a failure.
#define NEEDS_ENGINE(engine)                                                  \
    if (!::grainreel::test::has_engine(engine)) {                             \
        if (std::getenv("GRAINREEL_ENGINES_WANTED") != nullptr)               \
            GTEST_FAIL() << name_of(engine) << " or mpirun is not installed"; \
        GTEST_SKIP() << name_of(engine) << " or mpirun is not installed";     \
    }

}  // namespace grainreel::test
