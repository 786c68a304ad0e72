// Words for a POSIX shell.
#pragma once

#include <string>
#include <vector>

namespace grainreel {

// A word as a shell needs it typed: in single quotes where it has anything but letters, digits and harmless
// signs.
std::string shell_word(const std::string& word);
// Several, with spaces between them.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace grainreel
