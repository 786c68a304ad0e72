#include "engine/files/foreign/bytes/decimal.hpp"

#include <array>
#include <bit>

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

}  // namespace

double scale_exactly(std::uint64_t w, int e) {
    if (e >= 0) {
        const Wide product = Wide{w} * fives[e];
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

}  // namespace grainreel
