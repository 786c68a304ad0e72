// Messages of the program, tested by their key words, so that a sentence can be put better without a change
// here.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainreel::test {

// Whether the words stand in the text one after the other.
inline bool has_in_order(std::string_view text, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        const std::size_t place = text.find(word);
        if (place == std::string_view::npos) return false;
        text.remove_prefix(place + word.size());
    }
    return true;
}

MATCHER_P(TellsInOrder, words, (negation ? "tells not " : "tells ") + testing::PrintToString(words)) {
    const std::string text(arg);
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        if (has_in_order(line, words)) return true;
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    return false;
}

// One line of the text tells these words, in this order: the place (`path.csv:6`), the key or name, the
// values, and one word of what is wrong or of the remedy.
inline auto tells(std::vector<std::string> words) {
    return TellsInOrder(std::move(words));
}

MATCHER(IsOneLine, negation ? "has several lines" : "is one line") {
    const std::string text(arg);
    return std::count(text.begin(), text.end(), '\n') == (text.ends_with('\n') ? 1 : 0);
}

// The same, and the text says nothing else.
inline auto tells_only(std::vector<std::string> words) {
    return testing::AllOf(IsOneLine(), TellsInOrder(std::move(words)));
}

}  // namespace grainreel::test
