#include "engine/files/foreign/decimal.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace grainreel {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr auto fives = [] {
    std::array<std::uint64_t, 28> all{};
    all[0] = 1;
    for (std::size_t k = 1; k < all.size(); ++k) all[k] = 5 * all[k - 1];
    return all;
}();

constexpr int dropped = 64 - 53;  // bits
constexpr std::uint64_t half = std::uint64_t{1} << (dropped - 1);

std::uint64_t rest_of(std::uint64_t m) {
    return m & ((std::uint64_t{1} << dropped) - 1);
}

// kept 2^e, which is a normal double.
double assembled(std::uint64_t kept, int e) {
    const auto scale = static_cast<std::uint64_t>(1023 + e) << 52;
    return static_cast<double>(kept) * std::bit_cast<double>(scale);
}

// The double nearest to (m + more) 2^e. The highest bit of m is set, and 0 <= more < 1; only whether it is
// more than 0 matters.
double rounded(std::uint64_t m, bool more, int e) {
    const std::uint64_t rest = rest_of(m);
    std::uint64_t kept = m >> dropped;
    if (rest > half || (rest == half && (more || (kept & 1) != 0))) ++kept;
    return assembled(kept, e + dropped);
}

// a 2^63 / b, rounded to 53 bits, times 2^e. The highest bits of a and b are set. It divides, so it is always
// right.
double divided(std::uint64_t a, std::uint64_t b, int e) {
    const int extra = a < b ? 1 : 0;  // gives the quotient 64 bits
    const Wide shifted = Wide{a} << (63 + extra);
    const auto quotient = static_cast<std::uint64_t>(shifted / b);
    return rounded(quotient, Wide{quotient} * b != shifted, e - extra);
}

// 2^127 / (5^k 2^s), rounded down, where s shifts the highest bit of 5^k to the top. It has 64 bits for k >
// 0.
constexpr auto inverses = [] {
    std::array<std::uint64_t, 28> all{};
    for (std::size_t k = 1; k < all.size(); ++k)
        all[k] = static_cast<std::uint64_t>((Wide{1} << 127) / (fives[k] << std::countl_zero(fives[k])));
    return all;
}();

bool same(std::string_view word, std::string_view lower) {
    if (word.size() != lower.size()) return false;
    for (std::size_t k = 0; k < word.size(); ++k)
        if ((word[k] | 0x20) != lower[k]) return false;
    return true;
}

// Reads "nan", "inf" and the words of Windows' C library until 2015: "1.#QNAN", "1.#IND", "1.#INF".
bool not_finite(std::string_view word, double& value) {
    const bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (word.starts_with("nan(") || same(word, "nan") || word.starts_with("1.#QNAN") ||
        word.starts_with("1.#SNAN") || word.starts_with("1.#IND"))
        value = std::numeric_limits<double>::quiet_NaN();
    else if (same(word, "inf") || same(word, "infinity") || word.starts_with("1.#INF"))
        value = negative ? -infinite : infinite;
    else
        return false;
    return true;
}

// from_chars reports "out of range" for 1e-400 and for 1e400, so this finds out which it is.
double beyond_range(std::string_view word) {
    const bool negative = word.starts_with('-');
    const std::size_t exponent = word.find_first_of("eE");
    bool tiny = false;
    if (exponent != std::string_view::npos) {
        tiny = word.substr(exponent + 1).starts_with('-');
    } else {
        const std::size_t digit = word.find_first_not_of("-0");
        tiny = digit != std::string_view::npos && word[digit] == '.';
    }
    const double size = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return negative ? -size : size;
}

}  // namespace

double scale_exactly(std::uint64_t w, int e) {
    if (e >= 0) {
        const Wide product = Wide{w} * fives[static_cast<std::size_t>(e)];
        const auto high = static_cast<std::uint64_t>(product >> 64),
                   low = static_cast<std::uint64_t>(product);
        if (high == 0) {
            const int up = std::countl_zero(low);
            return rounded(low << up, false, e - up);
        }
        const int up = std::countl_zero(high);
        const Wide level = product << up;
        return rounded(static_cast<std::uint64_t>(level >> 64), static_cast<std::uint64_t>(level) != 0,
                       e + 64 - up);
    }
    // The inverse is less than 2^127/b by less than 1. So a/2^64 times the inverse is less than t = 2^63 a/b
    // by less than 1, and its whole part m by less than 2: m <= t < m + 2. If m has only 63 bits, everything
    // is doubled and one more bit of the product is used: m <= t < m + 3. This decides on which side of the
    // half t lies, unless the half is m, m + 1 or m + 2. If m + 3 is beyond the next number that is kept,
    // that number is still the nearest.
    const auto k = static_cast<std::size_t>(-e);
    const int shift = std::countl_zero(w);
    const int by_shift = std::countl_zero(fives[k]);
    const std::uint64_t a = w << shift, b = fives[k] << by_shift;
    const int scale = e + by_shift - shift - 63;
    const Wide product = Wide{a} * inverses[k];
    auto m = static_cast<std::uint64_t>(product >> 64);
    const int short_of = std::countl_zero(m);  // 0 or 1
    if (short_of == 1) m = static_cast<std::uint64_t>(product >> 63);
    const std::uint64_t rest = rest_of(m);
    if (rest <= half && rest + 3 > half) return divided(a, b, scale);
    return assembled((m >> dropped) + (rest > half ? 1 : 0), scale - short_of + dropped);
}

bool any_number(std::string_view word, double& value) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    if (word.empty()) return false;
    if (not_finite(word, value)) return true;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return false;
    if (error == std::errc::result_out_of_range) value = beyond_range(word);
    return true;
}

}  // namespace grainreel
