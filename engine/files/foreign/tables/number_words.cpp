#include "engine/files/foreign/tables/number_words.hpp"

#include <algorithm>

#include "engine/base/number_text.hpp"

namespace grainreel {

std::string_view take_word(std::string_view& text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; };
    std::size_t first = 0;
    while (first < text.size() && is_blank(text[first])) ++first;
    std::size_t last = first;
    while (last < text.size() && !is_blank(text[last])) ++last;
    const std::string_view word = text.substr(first, last - first);
    text.remove_prefix(last);
    return word;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
        words.push_back(word);
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    split_words(line, words);
    return words;
}

std::size_t count_words(std::string_view line, std::size_t most) {
    std::size_t count = 0;
    while (count < most && !take_word(line).empty()) ++count;
    return count;
}

std::optional<std::vector<double>> numbers_of(std::string_view line) {
    std::vector<double> numbers;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        const std::optional<double> number = number_in(word, Dialect::programs);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t most = 40;
    std::string text = "\"";
    for (const char c : word.substr(0, most))
        text += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return text + (word.size() > most ? "...\"" : "\"");
}

namespace {

std::optional<bool> truth_of(std::string_view word) {
    if (word == "T" || word == "1") return true;
    if (word == "F" || word == "0") return false;
    const std::string lower = lower_case(word);
    if (lower == "t" || lower == "true") return true;
    if (lower == "f" || lower == "false") return false;
    return std::nullopt;
}

}  // namespace

const char* name_of_wrong(CellKind kind) {
    return kind == CellKind::logical ? "neither T nor F" : "no number";
}

bool ColumnFiller::add_word(std::string_view word) {
    auto entry = numbers_.find(word);
    if (entry == numbers_.end())
        entry = numbers_.emplace(std::string(word), static_cast<double>(numbers_.size())).first;
    column_.values.push_back(entry->second);
    return true;
}

bool ColumnFiller::add(std::string_view word) {
    if (kind_ == CellKind::number) {
        const std::optional<double> value = number_in(word, Dialect::programs);
        if (value) column_.values.push_back(*value);
        return value.has_value();
    }
    if (kind_ == CellKind::logical) {
        const std::optional<bool> truth = truth_of(word);
        if (truth) column_.values.push_back(*truth ? 1.0 : 0.0);
        return truth.has_value();
    }
    return add_word(word);
}

RawColumn ColumnFiller::finish() {
    if (kind_ == CellKind::logical) column_.words = {"F", "T"};
    if (kind_ != CellKind::word && kind_ != CellKind::word_or_number) return std::move(column_);
    const bool whole = kind_ == CellKind::word_or_number &&
                       std::all_of(numbers_.begin(), numbers_.end(),
                                   [](const auto& entry) { return whole_in(entry.first).has_value(); });
    std::vector<double> meant(numbers_.size());
    double place = 0;
    for (const auto& [word, number] : numbers_) {
        meant[static_cast<std::size_t>(number)] = whole ? static_cast<double>(*whole_in(word)) : place++;
        if (!whole) column_.words.push_back(word);
    }
    for (double& value : column_.values) value = meant[static_cast<std::size_t>(value)];
    return std::move(column_);
}

}  // namespace grainreel
