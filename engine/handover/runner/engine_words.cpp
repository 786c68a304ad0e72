#include "engine/handover/runner/engine_words.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongest = 400;  // characters of a line that are quoted

// Words with one blank between, as far as a comment.
std::string words_of(const std::string& line) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string text;
    for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
    return text;
}

// The lines of a deck by their words; a line that is there twice counts where it is last.
std::map<std::string, int> lines_of(const fs::path& deck) {
    std::map<std::string, int> lines;
    std::ifstream file(deck);
    int number = 1;
    for (std::string line; std::getline(file, line); ++number)
        if (const std::string words = words_of(line); !words.empty()) lines[words] = number;
    return lines;
}

// Not those of Open MPI about itself.
bool is_error(const std::string& line) {
    return line.rfind("ERROR", 0) == 0;
}

std::string cut(const std::string& text) {
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

}  // namespace

std::string engine_error(const fs::path& output, const fs::path& deck) {
    const std::map<std::string, int> lines = lines_of(deck);
    std::ifstream said(output);
    std::string command, last;
    int at = 0;
    for (std::string line; std::getline(said, line);) {
        const std::string words = words_of(line);
        if (is_error(line)) {
            const std::string where =
                at > 0 ? fmt::format("{}:{}", deck.filename().string(), at) : deck.filename().string();
            return fmt::format("{}: {}{}", where, cut(line),
                               command.empty() ? "" : fmt::format(" (at `{}`)", cut(command)));
        }
        const auto found = lines.find(words);
        if (found == lines.end()) continue;
        command = words;
        at = found->second;
    }
    return "";
}

}  // namespace grainreel
