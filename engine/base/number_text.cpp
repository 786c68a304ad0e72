#include "engine/base/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "engine/base/text.hpp"

namespace grainreel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// from_chars() knows no plus sign before a number.
std::string_view without_plus(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return word;
}

// The exponent of ten behind the "e" of a number. One of too many digits is as large as it need be.
std::int64_t power_in(std::string_view exponent) {
    constexpr std::int64_t large = std::int64_t{1} << 60;
    exponent = without_plus(exponent);
    std::int64_t power = 0;
    const auto read = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
    if (read.ec == std::errc::result_out_of_range) return exponent.starts_with('-') ? -large : large;
    return power;
}

// 0 or infinity, with its sign, for a number beyond the range of a double. The place of its first digit that
// is not 0 and the exponent tell which, because from_chars() reports both as out of range.
double beyond_range(std::string_view word) {
    const std::size_t end = std::min(word.find_first_of("eE"), word.size());
    const std::string_view digits = word.substr(0, end);
    const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), end));
    const auto first = static_cast<std::int64_t>(std::min(digits.find_first_of("123456789"), end));
    const std::int64_t power = end < word.size() ? power_in(word.substr(end + 1)) : 0;
    const double size = power + point > first ? infinite : 0.0;
    return word.starts_with('-') ? -size : size;
}

// "1.#QNAN", "1.#SNAN", "-1.#IND" and "1.#INF". Digits may follow, as many as the format of the number had.
std::optional<double> number_of_windows(std::string_view word) {
    const bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    if (word.starts_with("1.#INF")) return negative ? -infinite : infinite;
    constexpr std::array<std::string_view, 3> none{"1.#QNAN", "1.#SNAN", "1.#IND"};
    const bool known = std::any_of(none.begin(), none.end(),
                                   [word](std::string_view begin) { return word.starts_with(begin); });
    return known ? std::optional(std::numeric_limits<double>::quiet_NaN()) : std::nullopt;
}

// A word of which from_chars() reads only the first `read` characters.
std::optional<double> odd_number(std::string_view word, std::size_t read) {
    const char next = word[read];
    if (next == '#') return number_of_windows(word);
    if (read == 0 || (next != 'd' && next != 'D')) return std::nullopt;
    std::string with_e(word);
    with_e[read] = 'e';
    if (with_e.find_first_of("dD") != std::string::npos) return std::nullopt;
    return number_in(with_e, Dialect::programs);
}

}  // namespace

std::optional<double> number_in(std::string_view word, Dialect dialect) {
    word = without_plus(word);
    if (word.empty()) return std::nullopt;
    const char *const begin = word.data(), *const end = begin + word.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (stop != end) {
        if (dialect == Dialect::plain) return std::nullopt;
        return odd_number(word, static_cast<std::size_t>(stop - begin));
    }
    if (error == std::errc::result_out_of_range) value = beyond_range(word);
    if (dialect == Dialect::plain && !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> whole_in(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

double decimal_of(float value) {
    constexpr float whole = 1 << 24;
    if (!(std::abs(value) < whole) || value == std::trunc(value)) return value;
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    double decimal = value;
    if (error == std::errc()) std::from_chars(digits, end, decimal);
    return decimal;
}

std::string no_number(std::string_view word) {
    if (word.empty()) return "a number is missing";
    return fmt::format("\"{}\" is not a finite number", excerpt(word));
}

}  // namespace grainreel
