#include "render/page/facts/differences.hpp"

#include <cstdlib>
#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/page/embed.hpp"

namespace grainreel {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

// What a line of a resolved scene says after its value is a comment; no value of it has a # outside of
// quotes.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (quote == 0 && line[i] == '#') return trimmed(line.substr(0, i));
        if (line[i] != '"' && line[i] != '\'') continue;
        quote = quote == 0 ? line[i] : quote == line[i] ? 0 : quote;
    }
    return trimmed(line);
}

// Numbers to six digits: what differs by rounding is the same.
std::string shown(const std::string& value) {
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    return !value.empty() && *end == '\0' ? fmt::format("{:.6g}", number) : value;
}

std::map<std::string, std::string> keys_of_file(const std::filesystem::path& file) {
    try {
        return keys_of_scene(load_scene_file(file));
    } catch (const UserError&) {
        return {};
    }
}

}  // namespace

std::map<std::string, std::string> keys_of_scene(std::string_view text) {
    std::map<std::string, std::string> keys;
    std::map<std::string, int> tables;  // of [[name]], how many there were
    std::string table, last;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = without_comment(text.substr(0, end));
        text.remove_prefix(std::min(text.size(), end + 1));
        const std::size_t equals = line.find('=');
        if (line.starts_with("[[") && line.ends_with("]]")) {
            const std::string name(line.substr(2, line.size() - 4));
            table = fmt::format("{}.{}.", name, ++tables[name]);
        } else if (line.starts_with("[") && line.ends_with("]") && equals == std::string_view::npos) {
            table = std::string(line.substr(1, line.size() - 2)) + ".";
        } else if (equals != std::string_view::npos) {
            last = table + std::string(trimmed(line.substr(0, equals)));
            keys[last] = std::string(trimmed(line.substr(equals + 1)));
        } else if (!line.empty() && !last.empty()) {
            keys[last] += std::string(line);  // a value that goes on
        }
    }
    return keys;
}

std::string differences_html(const std::vector<NamedScene>& scenes) {
    std::vector<std::map<std::string, std::string>> all;
    std::set<std::string> names;
    for (const NamedScene& scene : scenes) {
        all.push_back(keys_of_file(scene.file));
        for (const auto& [key, value] : all.back()) names.insert(key);
    }
    std::string rows;
    for (const std::string& name : names) {
        std::set<std::string> values;
        std::string cells;
        for (const auto& keys : all) {
            const auto found = keys.find(name);
            const std::string value = found == keys.end() ? "–" : shown(found->second);
            values.insert(value);
            cells += fmt::format("<td>{}</td>", html_text(value));
        }
        if (values.size() > 1)
            rows += fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", html_text(name), cells);
    }
    std::string html =
        "<section aria-labelledby=\"differences\">\n<h2 id=\"differences\">What differs</h2>\n";
    if (rows.empty()) return html + "<p>The scenes are the same.</p>\n</section>\n";
    std::string heads;
    for (const NamedScene& scene : scenes)
        heads += fmt::format("<th scope=\"col\">{}</th>", html_text(scene.name));
    return html +
           fmt::format(
               "<p>Plain numbers are in SI units, phases in turns, the camera's angles in degrees.</p>\n"
               "<div class=\"table\" tabindex=\"0\" role=\"region\" "
               "aria-label=\"Keys that differ\">\n<table>\n"
               "<thead><tr><th scope=\"col\">key</th>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n</div>\n"
               "</section>\n",
               heads, rows);
}

}  // namespace grainreel
