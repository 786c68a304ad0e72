#include "render/page/facts/run_names.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/page/facts/differences.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

using Names = std::vector<std::string>;
using Values = std::vector<std::string>;  // of a key, one a run

constexpr std::size_t most_said = 3;  // keys in a name

bool all_differ(const Names& names) {
    const std::set<std::string> set(names.begin(), names.end());
    return set.size() == names.size() && set.count("") == 0;
}

// "species.2.count" -> "species[1].count", as the list of keys knows it.
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

// Whether a key says what the run was, and neither how it is shown nor what followed from other keys.
bool tells(const std::string& key) {
    for (const char* other : {"film.", "output.", "title", "run.threads"})
        if (key.starts_with(other)) return false;
    if (key.starts_with("mesh.") && key.ends_with("hash")) return false;  // of a file that its path names
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
    const bool has_unit = known != nullptr && known->dimension != Dimension::number;
    return fmt::format("{:.4g}{}", number,
                       has_unit ? fmt::format(" {}", text_of(known->dimension).unit) : "");
}

// Name and values of each key that differs; keys of one name with the same values come once.
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

// Experimenters speak of Γ rather than of the amplitude.
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

// Nothing where too much differs, or too little.
Names names_by_keys(const std::vector<RunToName>& runs) {
    std::vector<std::pair<std::string, Values>> differing;
    try {
        differing = differences(runs);
    } catch (const UserError&) {
        return {};
    }
    if (differing.empty() || differing.size() > most_said) return {};
    say_as_level(runs, differing);
    Names names(runs.size());
    for (const auto& [key, values] : differing)
        for (std::size_t k = 0; k < runs.size(); ++k)
            names[k] += fmt::format("{}{} = {}", names[k].empty() ? "" : ", ", key, values[k]);
    return names;
}

}  // namespace

Names names_of_runs(const std::vector<RunToName>& runs) {
    Names titles, folders, paths;
    for (const RunToName& run : runs) {
        titles.push_back(run.scene.title);
        folders.push_back(run.folder.filename().string());
        paths.push_back(run.folder.string());
    }
    for (const Names& names : {titles, names_by_keys(runs), folders})
        if (names.size() == runs.size() && all_differ(names)) return names;
    return paths;
}

}  // namespace grainreel
