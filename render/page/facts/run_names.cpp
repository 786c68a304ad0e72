#include "render/page/facts/run_names.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/units.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

using Names = std::vector<std::string>;
using Values = std::vector<std::string>;  // values of a key, one for each run

constexpr std::size_t most_said = 3;  // largest number of keys in a name

bool all_differ(const Names& names) {
    const std::set<std::string> set(names.begin(), names.end());
    return set.size() == names.size() && set.count("") == 0;
}

// The key as find_key() takes it: "species[2].count" for "species.2.count". find_key() ignores the number.
std::string path_of(const std::string& key) {
    std::string path;
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t end = std::min(key.find('.', begin), key.size());
        const std::string part = key.substr(begin, end - begin);
        const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
        path += number ? "[" + part + "]" : (path.empty() ? "" : ".") + part;
        begin = end + 1;
    }
    return path;
}

// Whether a key describes the run itself; false for keys that say how it is shown or that follow from others.
bool tells(const std::string& key) {
    for (const char* other : {"film.", "output.", "title", "run.threads"})
        if (key.starts_with(other)) return false;
    if (key.starts_with("mesh.") && key.ends_with("hash")) return false;  // the path names that file already
    const Key* known = find_key(path_of(key), filmed_scene_keys());
    return known == nullptr || !known->often_chosen;
}

std::string value_text(const std::string& key, const std::string& value) {
    if (value.empty()) return "none";
    if (value.size() > 1 && value.front() == '"') return value.substr(1, value.size() - 2);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (*end != '\0') return value;
    const Key* known = find_key(path_of(key), filmed_scene_keys());
    if (known == nullptr || known->dimension == Dimension::number) return fmt::format("{:.4g}", number);
    if (known->dimension != Dimension::length)
        return fmt::format("{:.4g} {}", number, text_of(known->dimension).unit);
    const std::string unit = fitting_unit(std::abs(number), Dimension::length);
    return fmt::format("{:.4g} {}", number / unit_size(unit, Dimension::length), unit);
}

// Name and values of each key that differs. Keys with the same name and the same values are listed once.
std::vector<std::pair<std::string, Values>> differences(const std::vector<RunToName>& runs) {
    std::map<std::string, Values> all;
    for (std::size_t k = 0; k < runs.size(); ++k)
        for (const auto& [key, value] : keys_of_scene(load_scene_file(runs[k].folder / "scene.toml"))) {
            if (!tells(key)) continue;
            Values& values = all[key];
            values.resize(runs.size(), "none");
            values[k] = value_text(key, value);
        }
    std::vector<std::pair<std::string, Values>> differing;
    for (const auto& [key, values] : all) {
        const std::pair<std::string, Values> one{name_of(key), values};
        const bool differs =
            std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) != values.end();
        if (differs && std::find(differing.begin(), differing.end(), one) == differing.end())
            differing.push_back(one);
    }
    return differing;
}

// Replaces the amplitude by Γ, which experimenters prefer, if every run vibrates in one way under gravity.
void say_as_level(const std::vector<RunToName>& runs,
                  std::vector<std::pair<std::string, Values>>& differing) {
    const auto amplitude = std::find_if(differing.begin(), differing.end(),
                                        [](const auto& one) { return one.first == "amplitude"; });
    const bool shaken = std::all_of(runs.begin(), runs.end(), [](const RunToName& run) {
        return run.scene.drive.present && !run.scene.drive.changes() && run.scene.gravity.norm() > 0;
    });
    if (amplitude == differing.end() || !shaken) return;
    amplitude->first = "Γ";
    for (std::size_t k = 0; k < runs.size(); ++k)
        amplitude->second[k] =
            fmt::format("{:.3g}", runs[k].scene.drive.g_level(runs[k].scene.gravity.norm()));
}

// Names made from the keys that differ; empty when too many or too few keys differ.
Names names_by_keys(const std::vector<RunToName>& runs) {
    std::vector<std::pair<std::string, Values>> differing;
    try {
        differing = differences(runs);
    } catch (const UserError&) {
        return {};
    }
    if (differing.empty() || differing.size() > most_said) return {};
    say_as_level(runs, differing);
    for (auto& [key, values] : differing) key = phrase(runs.front().scene.film.wording.language, key);
    Names names(runs.size());
    for (const auto& [key, values] : differing)
        for (std::size_t k = 0; k < runs.size(); ++k)
            names[k] += fmt::format("{}{} = {}", names[k].empty() ? "" : ", ", key, values[k]);
    return names;
}

}  // namespace

Names names_of_runs(const std::vector<RunToName>& runs) {
    Names given, titles, folders, paths;
    for (const RunToName& run : runs) {
        given.push_back(run.given);
        titles.push_back(run.scene.title);
        folders.push_back(run.folder.filename().string());
        paths.push_back(run.folder.string());
    }
    for (const Names& names : {given, titles, names_by_keys(runs), folders})
        if (names.size() == runs.size() && all_differ(names)) return names;
    return paths;
}

namespace {

// The line of a resolved scene without the comment behind its value. No value has a # outside of quotes.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (quote == 0 && line[i] == '#') return trimmed(line.substr(0, i));
        if (line[i] != '"' && line[i] != '\'') continue;
        quote = quote == 0 ? line[i] : quote == line[i] ? 0 : quote;
    }
    return trimmed(line);
}

// A value as it is shown. Numbers get six digits, so that values which differ only by rounding look the same.
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

namespace {

// The entries between the braces of an inline table, "width = 0.018" and so on.
std::vector<std::string> entries_of(std::string_view table) {
    std::vector<std::string> entries(1);
    int depth = 0;
    bool quoted = false;
    for (const char c : table.substr(1, table.size() - 2)) {
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '{' || c == '[')) ++depth;
        if (!quoted && (c == '}' || c == ']')) --depth;
        if (c == ',' && depth == 0 && !quoted)
            entries.emplace_back();
        else
            entries.back() += c;
    }
    return entries;
}

// Gives each entry of an inline table a key of its own: "container.outlet.width". A range stays one value.
void open_inline_tables(std::map<std::string, std::string>& keys) {
    std::map<std::string, std::string> opened;
    for (const auto& [key, value] : keys) {
        const bool is_table = value.size() > 2 && value.front() == '{' && value.back() == '}';
        if (!is_table || trimmed(std::string_view(value).substr(1)).starts_with("min")) {
            opened[key] = value;
            continue;
        }
        for (const std::string& entry : entries_of(value)) {
            const std::size_t equals = std::min(entry.find('='), entry.size());
            const std::string name(trimmed(std::string_view(entry).substr(0, equals)));
            if (equals < entry.size())
                opened[key + "." + name] = std::string(trimmed(std::string_view(entry).substr(equals + 1)));
        }
    }
    keys = std::move(opened);
}

}  // namespace

std::map<std::string, std::string> keys_of_scene(std::string_view text) {
    std::map<std::string, std::string> keys;
    std::map<std::string, int> tables;  // for each [[name]], how many there were so far
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
            keys[last] += std::string(line);  // the value continues on this line
        }
    }
    open_inline_tables(keys);
    return keys;
}

std::string differences_html(const std::vector<NamedScene>& scenes, const PageWords& say) {
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
        fmt::format("<section aria-labelledby=\"differences\">\n<h2 id=\"differences\">{}</h2>\n",
                    html_text(say("What differs")));
    if (rows.empty())
        return html + fmt::format("<p>{}</p>\n</section>\n", html_text(say("The scenes are the same.")));
    std::string heads;
    for (const NamedScene& scene : scenes)
        heads += fmt::format("<th scope=\"col\">{}</th>", html_text(scene.name));
    return html + fmt::format(
                      "<p>{2}</p>\n"
                      "<div class=\"table\" tabindex=\"0\" role=\"region\" "
                      "aria-label=\"{3}\">\n<table>\n"
                      "<thead><tr><th "
                      "scope=\"col\">{4}</th>{0}</tr></thead>\n<tbody>\n{1}</tbody>\n</table>\n</div>\n"
                      "</section>\n",
                      heads, rows,
                      html_text(say(
                          "Plain numbers are in SI units, phases in turns, the camera's angles in degrees.")),
                      html_text(say("Keys that differ")), html_text(say("key")));
}

}  // namespace grainreel
