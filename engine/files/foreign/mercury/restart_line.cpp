#include "engine/files/foreign/mercury/restart_line.hpp"

#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

RestartLine::RestartLine(std::string_view line) {
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        if (first_word_.empty()) first_word_ = word;
        const std::optional<double> number = number_of(word);
        if (!number) {
            entries_.emplace_back(lower_case(word), std::vector<double>());
        } else if (!entries_.empty()) {
            entries_.back().second.push_back(*number);
        }
    }
}

const std::vector<double>* RestartLine::find(std::string_view key, std::size_t count) const {
    const std::string wanted = lower_case(key);
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
        if (entry->first == wanted && entry->second.size() == count) return &entry->second;
    return nullptr;
}

std::optional<double> RestartLine::number(std::string_view key) const {
    const std::vector<double>* found = find(key, 1);
    return found ? std::optional(found->front()) : std::nullopt;
}

std::optional<Vec3> RestartLine::vector(std::string_view key) const {
    const std::vector<double>* found = find(key, 3);
    if (!found) return std::nullopt;
    return Vec3((*found)[0], (*found)[1], (*found)[2]);
}

const std::vector<double>& RestartLine::first_numbers() const {
    static const std::vector<double> none;
    for (const auto& [key, numbers] : entries_)
        if (!numbers.empty()) return numbers;
    return none;
}

}  // namespace grainreel
