// Numbers of things in messages: "1 frame", "3 frames".
#pragma once

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

namespace grainreel {

// The number and its noun, which gets an s unless the number is 1.
template <class Number>
requires std::is_arithmetic_v<Number> std::string counted(Number number, std::string_view noun) {
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

}  // namespace grainreel
