#include "engine/files/foreign/tables/column_filler.hpp"

#include <algorithm>

#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

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
    auto found = numbers_.find(word);
    if (found == numbers_.end())
        found = numbers_.emplace(std::string(word), static_cast<double>(numbers_.size())).first;
    column_.values.push_back(found->second);
    return true;
}

bool ColumnFiller::add(std::string_view word) {
    if (kind_ == CellKind::number) {
        const std::optional<double> value = number_of(word);
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
                       std::all_of(numbers_.begin(), numbers_.end(), [](const auto& entry) {
                           return whole_number_of(entry.first).has_value();
                       });
    std::vector<double> meant(numbers_.size());
    double place = 0;
    for (const auto& [word, number] : numbers_) {
        meant[static_cast<std::size_t>(number)] =
            whole ? static_cast<double>(*whole_number_of(word)) : place++;
        if (!whole) column_.words.push_back(word);
    }
    for (double& value : column_.values) value = meant[static_cast<std::size_t>(value)];
    return std::move(column_);
}

}  // namespace grainreel
