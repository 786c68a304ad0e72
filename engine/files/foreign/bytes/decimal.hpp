// Reads decimal numbers in text files fast. The result is the nearest double (ties to even), exactly as
// strtod gives it. It is inline because readers of large files call it for every number.
//
// A plain decimal of at most 19 digits is w 10^e with a whole w < 2^64. If w < 2^53 and |e| <= 22, w and
// 10^|e| are exact doubles, so that one multiplication or division rounds correctly (W. D. Clinger, How to
// read floating point numbers accurately, PLDI 1990). If |e| <= 27, 5^|e| is a whole number below 2^63, and
// scale_exactly() can round w 5^e correctly. All other words go to number_in() (engine/base/number_text.hpp).
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <bit>
#include <cstdint>
#include <cstring>

namespace grainreel {

// w 10^e, rounded once. w > 0, |e| <= 27.
double scale_exactly(std::uint64_t w, int e);

namespace decimal_detail {

// 10^k and -10^k. A number gets its sign from the factor or divisor, and so does a zero.
inline constexpr double powers[2][23] = {
    {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
     1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22},
    {-1e0,  -1e1,  -1e2,  -1e3,  -1e4,  -1e5,  -1e6,  -1e7,  -1e8,  -1e9,  -1e10, -1e11,
     -1e12, -1e13, -1e14, -1e15, -1e16, -1e17, -1e18, -1e19, -1e20, -1e21, -1e22}};
inline constexpr int most_digits = 19;     // 10^19 - 1 < 2^64
inline constexpr int most_clinger = 22;    // 10^22 = 2^22 5^22, 5^22 < 2^53
inline constexpr int most_exact = 27;      // 5^27 < 2^63
inline constexpr int most_exponent = 999;  // the largest that is read here

inline bool digit_at(const char* p) {
    return static_cast<unsigned char>(*p - '0') < 10;
}

// The next eight characters as a number, with the first one in the lowest byte.
inline std::uint64_t eight_at(const char* p) {
    std::uint64_t v;
    std::memcpy(&v, p, sizeof v);
    if constexpr (std::endian::native == std::endian::big) v = __builtin_bswap64(v);
    return v;
}

// How many of eight characters, from the first one on, are digits. A digit xor '0' is at most 9. Larger
// values set the highest bit of their byte below, and no byte carries into the next.
inline int digits_of(std::uint64_t v) {
    const std::uint64_t x = v ^ 0x3030303030303030u;
    const std::uint64_t others =
        (((x & 0x7F7F7F7F7F7F7F7Fu) + 0x7676767676767676u) | x) & 0x8080808080808080u;
    return std::countr_zero(others) / 8;
}

// The number that eight digits make; bytes of 0 count as digits 0. Digits are combined in pairs, then in
// fours, then in eights.
inline std::uint64_t number_of(std::uint64_t v) {
    v = (v & 0x0F0F0F0F0F0F0F0Fu) * (10 * 256 + 1) >> 8;
    v = (v & 0x00FF00FF00FF00FFu) * (100 * 65536 + 1) >> 16;
    return (v & 0x0000FFFF0000FFFFu) * ((std::uint64_t{10000} << 32) + 1) >> 32;
}

// Number of zeros before the first other digit; a point between them does not count.
inline int leading_zeros(const char* p) {
    int zeros = 0;
    for (; *p == '0' || *p == '.'; ++p) zeros += *p == '0' ? 1 : 0;
    return zeros;
}

inline constexpr std::uint64_t whole_powers[9] = {1,      10,      100,      1000,     10000,
                                                  100000, 1000000, 10000000, 100000000};

// Adds digits to w. Returns the place after the last one.
inline const char* take_digits(const char* p, std::uint64_t& w) {
    while (true) {
        const std::uint64_t v = eight_at(p);
        const int count = digits_of(v);
        // The digits move to the end of the eight, with zeros before them. There are two shifts, because a
        // shift by 64 bits does nothing.
        w = w * whole_powers[count] + number_of(v << (56 - 7 * count) << (8 - count));
        p += count;
        if (count < 8) return p;
    }
}

// Reads "e-05" after a mantissa. Null where there is no exponent.
inline const char* take_exponent(const char* p, int& e) {
    ++p;
    const bool negative = *p == '-';
    if (negative || *p == '+') ++p;
    if (!digit_at(p)) return nullptr;
    int size = 0;
    while (digit_at(p)) {
        size = 10 * size + (*p++ - '0');
        if (size > most_exponent) return nullptr;
    }
    e += negative ? -size : size;
    return p;
}

}  // namespace decimal_detail

// Reads a plain decimal that begins at p. Returns the place after it, or null where number_in() must be
// used. That is also needed if the next character cannot follow a number ("1.#IND", "1.5d0"). After the
// number there must be a character that is not part of it, such as the end of a line, and 8 more bytes.
inline const char* plain_decimal(const char* p, double& value) {
    using namespace decimal_detail;
    const std::uint64_t negative = *p == '-' ? 1 : 0;
    p += negative;
    std::uint64_t w = 0;
    const char* const first = p;
    p = take_digits(p, w);
    auto digits = p - first;
    int e = 0;
    if (*p == '.') {
        const char* const fraction = ++p;
        p = take_digits(p, w);
        e = static_cast<int>(fraction - p);
        digits += p - fraction;
    }
    if (digits > most_digits) digits -= leading_zeros(first);  // they do not change w
    if (digits == 0 || digits > most_digits) return nullptr;
    if ((*p | 0x20) == 'e') {
        p = take_exponent(p, e);
        if (p == nullptr) return nullptr;
    }
    if (w < (std::uint64_t{1} << 53) && e <= most_clinger && e >= -most_clinger) {
        const auto whole = static_cast<double>(static_cast<std::int64_t>(w));
        value = e < 0 ? whole / powers[negative][-e] : whole * powers[negative][e];
    } else if (w != 0 && e <= most_exact && e >= -most_exact) {
        value = scale_exactly(w, e) * powers[negative][0];
    } else {
        return nullptr;
    }
    return p;
}

// The end of the word that begins at p: the first blank or control character. 16 bytes after it are read.
inline const char* word_end(const char* p) {
#ifdef __SSE2__
    const __m128i blank = _mm_set1_epi8(' ');
    while (true) {
        const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
        const int ends = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(v, blank), v));
        if (ends != 0) return p + std::countr_zero(static_cast<unsigned>(ends));
        p += sizeof v;
    }
#else
    while (static_cast<unsigned char>(*p) > ' ') ++p;
    return p;
#endif
}

}  // namespace grainreel
