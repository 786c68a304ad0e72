// Checkpoints, and runs that start or go on from the end of an earlier one.
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

// Writes everything that decides the future, including the scene, to a temporary name, then renames it.
// `gathered` is what observers have gathered (Observers::save), which decides nothing. `given` is how many
// grains each feed has given. Throws RunError when the file cannot be written.
void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given = {});

// The same with the text `kept`, which describes what the state belongs to, in place of the scene.
void save_checkpoint(const std::filesystem::path& path, const std::string& kept,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given);

// The state as save_checkpoint writes it, for hashes.
void write_state(std::ostream& out, std::int64_t step, const Grains& grains, const StepLoop& loop,
                 const std::vector<std::int64_t>& given = {});

// The scene of a run that goes on from a checkpoint, at its clock.
Scene continued(Scene scene, const std::filesystem::path& checkpoint);

// The functions below that read a checkpoint throw UserError, at the scene's `start.file` or at the key that
// differs, when the file is missing, damaged, of another version, or does not fit the scene. They check
// everything in the file.
//
// Lets the run go on with the same bits: reads grains, the loop's lists and histories, and how many grains
// each feed has given. The loop belongs to these grains. `gathered` becomes what observers had gathered,
// which the caller still has to check. may_change: the scene need not be that of the checkpoint.
CheckpointHeader continue_from_checkpoint(const Scene& scene, const Plan& plan, Grains& grains,
                                          StepLoop& loop, std::string& gathered,
                                          std::vector<std::int64_t>& given, bool may_change = false);
// Starts anew: gives the places of the grains in the container at rest, and their velocities; the masses
// are the scene's.
Grains grains_from_checkpoint(const Scene& scene);

// The contacts that those grains had, group by group of the rules that the checkpoint's own scene gives.
// Their bodies count grains in the order of grains_from_checkpoint(). Throws as above.
std::vector<KeptContacts> contacts_from_checkpoint(const Scene& scene, const ContactRules& rules,
                                                   const WallParts& walls);

// The error at the scene's `start.file` for a file that holds what this program does not write.
UserError damaged_checkpoint(const Scene& scene);

// A run that goes on where another stopped, with its clock, must be the same run: every value that decides
// its future must be what it was.
//
// A checkpoint holds the scene as it was used, as text, and this text is compared key by key. Keys that
// decide nothing may change; their entries say so (`decides_nothing`). A new key counts as deciding until
// its entry says otherwise.

// Whether a run goes on differently when this key ("species[1].count") differs.
bool decides_future(std::string_view key);

// The scene as text for a checkpoint: every value as it was used, without how the grains came to be.
std::string scene_to_keep(const Scene& scene, const Plan& plan);

struct KeyDifference {
    std::string key;
    std::string then, now;  // as TOML; empty where the key is not there
};
// The differences between two texts of the scene's writer, only in keys that decide the future. Keys that
// somebody wrote come before those that the plan chose.
std::vector<KeyDifference> deciding_differences(std::string_view then, std::string_view now);

// Differences between the two texts in all keys of one table, such as "output".
std::vector<KeyDifference> differences_of_table(std::string_view then, std::string_view now,
                                                std::string_view table);

// The differences in deciding keys between the scene that a checkpoint of `step` holds and the run's scene.
// Changes that were accepted after that step do not count. Without any difference the checkpoint belongs to
// this run. `kept` is the checkpoint's scene, as text of the scene's writer.
std::vector<KeyDifference> differences_of_future(const std::string& kept, const std::string& today,
                                                 std::int64_t step, const std::vector<AcceptedKey>& accepted);

// Throws UserError, at the key that differs, when a run of the kept scene cannot go on in this one.
void check_same_future(const std::string& kept, const Scene& scene, const Plan& plan);

}  // namespace grainreel
