// Checkpoints, and runs that go on from the end of an earlier one (init2 of the original program).
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/lists/saved_lists.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// Everything that decides the future, the scene among it, to a temporary name, then renamed. gathered: what
// observers have gathered (Observers::save), which decides nothing. given: how many grains each feed has
// given. Throws RunError when it cannot be written.
void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given = {});

// The same with `kept` in place of the scene, which says what the state is of.
void save_checkpoint(const std::filesystem::path& path, const std::string& kept,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given);

// The bytes behind save_checkpoint, for hashes.
void write_state(std::ostream& out, std::int64_t step, const Grains& grains, const StepLoop& loop,
                 const std::vector<std::int64_t>& given = {});

// Both throw UserError, at the scene's `start.file` or at the key that differs, when the file is missing,
// damaged, of another version, or does not fit the scene; nothing in it is believed.
//
// To go on bit by bit: grains, the loop's lists and histories, and what each feed has given. The loop is that
// of these grains. `gathered` becomes what observers had gathered, which the caller has still to check.
// may_change: the scene need not be the one of the checkpoint.
CheckpointHeader continue_from_checkpoint(const Scene& scene, const Plan& plan, Grains& grains,
                                          StepLoop& loop, std::string& gathered,
                                          std::vector<std::int64_t>& given, bool may_change = false);
// To start anew: where the grains are in the container at rest, and how fast; their masses are the scene's.
Grains grains_from_checkpoint(const Scene& scene);

// Beside those grains, in the same order: the contacts they had, group by group of the rules that the
// checkpoint's own scene gives. Throws as above.
std::vector<KeptContacts> contacts_from_checkpoint(const Scene& scene, const ContactRules& rules,
                                                   const WallParts& walls);

// At the scene's `start.file`, which holds what this program does not write.
UserError damaged_checkpoint(const Scene& scene);

}  // namespace grainreel
