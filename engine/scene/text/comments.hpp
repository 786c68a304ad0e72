// Comments of a scene file that is written again.
#pragma once

#include <string>
#include <string_view>

namespace grainreel {

// Both texts are of the scene's writer, a key a line. What `before` says above a key is said above it again,
// where the key has the value that it had, and nothing is said there yet.
std::string with_comments_of(std::string_view before, std::string text);

}  // namespace grainreel
