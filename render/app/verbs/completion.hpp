// Scripts that complete the command line in a shell: verbs, options, the words that an option takes, scenes,
// and the keys of a scene after --set.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/verbs/command_table.hpp"

namespace grainreel {

// What the scripts are made from. scenes: names of those that come with the program.
struct CompletionWords {
    std::vector<CommandVerb> verbs;
    std::vector<Key> keys;
    std::vector<std::string> scenes;
};

std::string bash_completion(const CompletionWords& words);
std::string zsh_completion(const CompletionWords& words);
std::string fish_completion(const CompletionWords& words);

}  // namespace grainreel
