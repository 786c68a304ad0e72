// What the C++ library of Emscripten 3.1 lacks: bit_cast, and numbers read from and written as text without a
// locale. The web build includes this before each file, and nothing else does.
#pragma once

#include <strings.h>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace std {  // NOLINT(cert-dcl58-cpp)

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

// Reads as the standard says: no blanks, no plus sign and no hexadecimal numbers. strtod of musl rounds once.
template <class Number>
requires is_floating_point_v<Number>
inline from_chars_result from_chars(const char* first, const char* last, Number& value,
                                    chars_format format = chars_format::general) {
    const char* at = first != last && *first == '-' ? first + 1 : first;
    const auto is_digit = [&](const char* p) { return p < last && *p >= '0' && *p <= '9'; };
    const bool word = last - at >= 3 && (strncasecmp(at, "inf", 3) == 0 || strncasecmp(at, "nan", 3) == 0);
    if (word) {
        at += last - at >= 8 && strncasecmp(at, "infinity", 8) == 0 ? 8 : 3;
    } else {
        const char* const begin = at;
        while (is_digit(at)) ++at;
        if (at < last && *at == '.' && (at > begin || is_digit(at + 1))) {
            ++at;
            while (is_digit(at)) ++at;
        }
        if (at == begin) return {first, errc::invalid_argument};
        if (format != chars_format::fixed && at < last && (*at == 'e' || *at == 'E')) {
            const char* power = at + 1;
            if (power < last && (*power == '+' || *power == '-')) ++power;
            if (is_digit(power))
                for (at = power; is_digit(at);) ++at;
        }
    }
    const string text(first, at);
    errno = 0;
    Number read;
    if constexpr (is_same_v<Number, float>)
        read = strtof(text.c_str(), nullptr);
    else
        read = static_cast<Number>(strtod(text.c_str(), nullptr));
    if (errno == ERANGE && (read == 0 || read - read != 0)) return {at, errc::result_out_of_range};
    value = read;
    return {at, errc()};
}

// The shortest text that reads as the same number.
inline to_chars_result to_chars(char* first, char* last, float value) {
    for (int digits = 6; digits <= 9; ++digits) {
        const int size =
            snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, static_cast<double>(value));
        if (strtof(first, nullptr) == value) return {first + size, errc()};
    }
    return {last, errc::value_too_large};
}

}  // namespace std
