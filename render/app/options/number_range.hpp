// A number in a range, for options.
#pragma once

#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

namespace grainreel {

// CLI::Range lets "nan" through.
inline CLI::Validator number_within(double low, double high) {
    return CLI::Validator(
        [low, high](const std::string& text) {
            double number = 0;
            const bool good = CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
            return good ? std::string()
                        : fmt::format("must be a number from {} to {}, but is {}", low, high, text);
        },
        "");
}

}  // namespace grainreel
