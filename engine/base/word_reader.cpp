#include "engine/base/word_reader.hpp"

#include <charconv>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"

namespace grainreel {
namespace {

constexpr bool is_end(char c) {
    return c == '\n' || c == '\r';
}
constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

constexpr std::size_t most_of_a_path = 400;  // characters of a path in a message

std::string shown(const std::filesystem::path& file) {
    return excerpt(file.string(), most_of_a_path);
}

}  // namespace

void WordReader::end_line() {
    left_.remove_prefix(left_.starts_with("\r\n") ? 2 : 1);
    ++line_;
}

std::string_view WordReader::take_word() {
    std::size_t size = 0;
    while (size < left_.size() && !is_blank(left_[size]) && !is_end(left_[size])) ++size;
    const std::string_view word = left_.substr(0, size);
    left_.remove_prefix(size);
    return word;
}

bool WordReader::has_word() {
    while (!left_.empty() && (is_blank(left_[0]) || is_end(left_[0]))) {
        if (is_end(left_[0]))
            end_line();
        else
            left_.remove_prefix(1);
    }
    return !left_.empty();
}

std::string_view WordReader::next() {
    has_word();
    return take_word();
}

// The end of a plain number is not looked for before it is read, which is faster.
std::optional<double> WordReader::next_number() {
    if (!has_word()) return std::nullopt;
    const char *const begin = left_.data(), *const end = begin + left_.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc() && (stop == end || is_blank(*stop) || is_end(*stop))) {
        left_.remove_prefix(static_cast<std::size_t>(stop - begin));
        return value;
    }
    const std::string_view before = left_;
    const std::optional<double> odd = number_in(take_word(), Dialect::programs);
    if (!odd) left_ = before;
    return odd;
}

std::string_view WordReader::next_in_line() {
    while (!left_.empty() && is_blank(left_[0])) left_.remove_prefix(1);
    return take_word();
}

void WordReader::skip_line() {
    std::size_t size = 0;
    while (size < left_.size() && !is_end(left_[size])) ++size;
    left_.remove_prefix(size);
    if (!left_.empty()) end_line();
}

bool same_word(std::string_view word, std::string_view lower_case) {
    if (word.size() != lower_case.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char c = word[i];
        if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c) != lower_case[i]) return false;
    }
    return true;
}

void refuse_file(const std::filesystem::path& file, const std::string& what) {
    throw UserError("{}: {}", shown(file), what);
}

void refuse_line(const std::filesystem::path& file, std::int64_t line, const std::string& what) {
    throw UserError("{}:{}: {}", shown(file), line, what);
}

void refuse_byte(const std::filesystem::path& file, std::size_t byte, const std::string& what) {
    throw UserError("{}: byte {}: {}", shown(file), byte, what);
}

}  // namespace grainreel
