// Numbers of things in messages: "1 frame", "3 frames".
#pragma once

#include <fmt/format.h>
#include <concepts>
#include <string>
#include <string_view>

namespace grainreel {

// The number and its noun, which gets an s unless the number is 1.
std::string counted(std::integral auto number, std::string_view noun) {
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

}  // namespace grainreel
