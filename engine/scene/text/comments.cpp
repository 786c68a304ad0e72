#include "engine/scene/text/comments.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace grainreel {

namespace {

// A line with a key, or a table's heading.
struct Line {
    std::string_view text, comment;  // the comment lines right above it, with their ends
    std::string place;               // its table's heading and how many of that came before, and the line
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
