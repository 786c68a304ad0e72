#include "tests/fuzz/damage.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace grainreel::fuzz {

namespace {

using Random = std::mt19937;
using Damage = void (*)(std::string& bytes, std::size_t at, Random& random);

template <std::size_t N>
std::string_view one_of(const std::array<std::string_view, N>& all, Random& random) {
    return all[random() % N];
}

void change_byte(std::string& bytes, std::size_t at, Random& random) {
    bytes[at] = static_cast<char>(random());
}

void change_letter(std::string& bytes, std::size_t at, Random& random) {
    constexpr std::string_view letters = "0123456789 \n\tIe.-,\"[]<>#=";
    bytes[at] = letters[random() % letters.size()];
}

void lose_bytes(std::string& bytes, std::size_t at, Random& random) {
    bytes.erase(at, 1 + random() % 200);
}

void cut_end(std::string& bytes, std::size_t at, Random&) {
    bytes.resize(at + 1);
}

void double_bytes(std::string& bytes, std::size_t at, Random& random) {
    bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 200));
}

void fill_word(std::string& bytes, std::size_t at, Random& random) {
    const std::size_t begin = at & ~std::size_t{3};
    const std::size_t end = std::min(bytes.size(), begin + (random() % 2 != 0U ? 4 : 8));
    const std::array<char, 3> fills{'\xff', '\x7f', '\0'};
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
              bytes.begin() + static_cast<std::ptrdiff_t>(end), fills[random() % fills.size()]);
}

// The line around that place, twice or not at all.
void change_line(std::string& bytes, std::size_t at, Random& random) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string::npos || end == at) return;
    const std::size_t before = bytes.rfind('\n', at);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    if (random() % 2 != 0U)
        bytes.insert(begin, bytes.substr(begin, end - begin + 1));
    else
        bytes.erase(begin, end - begin + 1);
}

void change_number(std::string& bytes, std::size_t at, Random& random) {
    constexpr std::array<std::string_view, 12> numbers{
        "0",     "-1",     "1000000000", "4294967295", "4294967297", "9223372036854775807",
        "1e308", "1e-320", "nan",        "inf",        "0.5",        "99999999999999999999999"};
    constexpr std::string_view digits = "0123456789";
    const std::size_t begin = bytes.find_first_of(digits, at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(bytes.find_first_not_of(digits, begin), bytes.size());
    bytes.replace(begin, end - begin, one_of(numbers, random));
}

constexpr std::array<Damage, 8> damages{change_byte,  change_letter, lose_bytes,  cut_end,
                                        double_bytes, fill_word,     change_line, change_number};

}  // namespace

void damage(std::string& bytes, std::mt19937& random) {
    if (bytes.empty()) bytes = "0";
    // Heads decide most: half of the damage is there.
    const std::size_t room = random() % 2 != 0U ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
    damages[random() % damages.size()](bytes, random() % room, random);
    if (bytes.empty()) bytes = "0";
}

}  // namespace grainreel::fuzz
