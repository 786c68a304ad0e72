#include "engine/scene/text/toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace grainreel {

std::string toml_number(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string toml_list(const std::vector<std::string>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string names_text(const std::vector<std::string>& names) {
    std::vector<std::string> words;
    for (const std::string& name : names) words.push_back(quoted(name));
    return words.empty() ? "" : toml_list(words);
}

// A phase beyond one turn is written with its unit; the reader takes a bare number for a mistake.
std::string as_toml(double value, Dimension dimension) {
    const bool many_turns = dimension == Dimension::phase && std::abs(value) > 1;
    return many_turns ? quoted(fmt::format("{} turn", value)) : toml_number(value);
}

std::string as_toml(const Vec3& value, Dimension) {
    return toml_list({toml_number(value.x()), toml_number(value.y()), toml_number(value.z())});
}

std::string as_toml(const std::string& value, Dimension) {
    return quoted(value);
}

void SceneText::put(const std::string& key, const std::string& value) {
    if (value.empty()) return;
    if (const auto found = remarks_.find(key); found != remarks_.end()) {
        comment(found->second);
        remarks_.erase(found);
    }
    text_ += fmt::format("{} = {}\n", key, value);
}

namespace {

// A line with a key, or a table's heading.
struct Line {
    std::string_view text, comment;  // the comment lines right above it, with their ends
    std::string place;  // heading of its table, how many of that heading came before, and the line
};

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> lines;
    std::map<std::string, int, std::less<>> tables;
    std::string table;
    std::size_t comment = text.npos;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        if (line.starts_with('#')) {
            if (comment == text.npos) comment = at;
        } else {
            if (line.starts_with('['))
                table = std::string(line) + std::to_string(tables[std::string(line)]++);
            const std::size_t begin = comment == text.npos ? at : comment;
            lines.push_back({line, text.substr(begin, at - begin), table + "\n" + std::string(line)});
            comment = text.npos;
        }
        at = end + 1;
    }
    return lines;
}

}  // namespace

std::string with_comments_of(std::string_view before, std::string text) {
    std::map<std::string, std::string_view> comments;
    for (const Line& line : lines_of(before))
        if (!line.comment.empty() && !line.text.empty()) comments[line.place] = line.comment;
    std::string all;
    for (const Line& line : lines_of(text)) {
        const auto known = comments.find(line.place);
        all += line.comment.empty() && known != comments.end() ? known->second : line.comment;
        all += line.text;
        all += '\n';
    }
    return all;
}

}  // namespace grainreel
