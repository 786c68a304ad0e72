// A run that goes on where another stopped, with its clock, must be the same run: every value that decides
// its future must be what it was.
//
// A checkpoint holds the scene as it was used, as text, and that is compared key by key. Keys that decide
// nothing may change; their entries say so (`decides_nothing`), and a new key decides until its entry does.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

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

// Likewise, all keys of one table, such as "output".
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
