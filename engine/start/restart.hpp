// Checkpoints, and runs that go on from the end of an earlier one (init2 of the original program).
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "engine/scene/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct CheckpointHeader {
    std::int64_t step = 0;
    double start_energy = 0;  // J, of the balance
    Vec3 wall_offset{0, 0, 0}, wall_velocity{0, 0, 0};
};

// Everything that decides the future, to a temporary name, then renamed. Throws RunError when it cannot be
// written.
void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop);

// The bytes behind save_checkpoint, for hashes.
void write_state(std::ostream& out, std::int64_t step, const Grains& grains, const StepLoop& loop);

// Reads grains and, for bit-identical continuation, the loop's lists and histories. Throws UserError, at the
// scene's `start.file`, when the file is missing, damaged, or (with keep_clock) of another plan.
CheckpointHeader load_checkpoint(const Scene& scene, const Plan& plan, Grains& grains, StepLoop* loop);

bool is_checkpoint(const std::filesystem::path& path);

}  // namespace grainreel
