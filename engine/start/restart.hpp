// Checkpoints, and runs that go on from the end of an earlier one (init2 of the original program).
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/keys/keys.hpp"
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

// A run that goes on where another stopped, with its clock, must be the same run: every value that decides
// its future must be what it was.
//
// A checkpoint holds the scene as it was used, as text, and that is compared key by key. Keys that decide
// nothing may change; their entries say so (`decides_nothing`), and a new key decides until its entry does.

// Whether a run goes on differently when this key ("species[1].count") differs.
bool decides_future(std::string_view key);

// The scene for a checkpoint: every value as it was used; how the grains came to be is left out.
std::string scene_to_keep(const Scene& scene, const Plan& plan);

struct KeyDifference {
    std::string key;
    std::string then, now;  // as TOML; empty: not there
};
// Between two texts of the scene's writer, only keys that decide: what somebody wrote before what the plan
// chose.
std::vector<KeyDifference> deciding_differences(std::string_view then, std::string_view now);

// Differences between the two texts in all keys of one table, such as "output".
std::vector<KeyDifference> differences_of_table(std::string_view then, std::string_view now,
                                                std::string_view table);

// What differs between the scene that a checkpoint of `step` holds and the run's, by the keys that decide.
// What was accepted after that step is no difference. None: the checkpoint is of this run. kept: as text, of
// the scene's writer.
std::vector<KeyDifference> differences_of_future(const std::string& kept, const std::string& today,
                                                 std::int64_t step, const std::vector<AcceptedKey>& accepted);

// Throws UserError, at the key that differs, when a run of the kept scene cannot go on in this one.
void check_same_future(const std::string& kept, const Scene& scene, const Plan& plan);

}  // namespace grainreel
