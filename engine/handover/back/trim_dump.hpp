// Prepares a dump for a run that goes on from an engine's restart file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// The engine's step of the newest restart file in the folder of its deck; none without one.
std::optional<std::int64_t> newest_restart(const std::filesystem::path& folder, PeerEngine engine);

// Cuts off what the dump has of steps behind `step` of the engine, which will come again, and a frame that
// was broken off. Throws UserError for a dump that is not the deck's, RunError where it cannot be cut.
void trim_dump(const std::filesystem::path& dump, std::int64_t step);

}  // namespace grainreel
