// Reads numbers in text from outside. Each is the nearest double (ties to even), whatever the locale says.
// Readers of files take their numbers from here, so that a word means the same in all formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace grainreel {

// Which words are numbers.
enum class Dialect {
    // Decimals that are finite: "1.5", "+1.5", ".5", "-2e-3". For surfaces, our own files and what people
    // write by hand.
    plain,
    // Also what programs write of results: "1.5d0" (Fortran); "nan", "-nan(ind)", "inf"; "1.#QNAN",
    // "-1.#IND", "1.#INF" (Windows' C library until 2015). Callers that need finite numbers must check.
    programs
};

// The number that the whole word stands for; none where it is no number of the dialect. What is too small for
// a double is 0. What is too large (1e400) is infinite, so that it is no number in the plain dialect.
std::optional<double> number_in(std::string_view word, Dialect dialect = Dialect::plain);

// The number in "324", "+324" or "-324"; none for anything else and for numbers of more than 64 bits.
std::optional<std::int64_t> whole_in(std::string_view word);

// The meaning of a float in a binary file: the shortest decimal number that rounds to it. A plate at 0.1 then
// stands at the same place, to the last bit, in a binary file and in a text file.
double decimal_of(float value);

// The reason why a word is no number: "\"nan\" is not a finite number".
std::string no_number(std::string_view word);

}  // namespace grainreel
