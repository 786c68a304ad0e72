// Finds shipped scenes and studies by their names. The build generates their lists, shipped_scenes() and so
// on, from the files in scenes/ (embed_scenes.cmake). A new scene needs no change here.
#include "engine/scene/shipped/shipped_scenes.hpp"

#include <algorithm>

#include "engine/base/text.hpp"

namespace grainreel {
namespace {

std::string plain_name(std::string_view name) {
    constexpr std::string_view extension = ".toml";
    if (name.size() > extension.size() && name.substr(name.size() - extension.size()) == extension)
        name.remove_suffix(extension.size());
    std::string plain(name);
    std::replace(plain.begin(), plain.end(), '-', '_');
    return plain;
}

// The first paragraph of the comment at the top of a text, as one line. An empty comment line ("#") ends it.
std::string first_comment(std::string_view text) {
    std::string comment;
    while (!text.empty() && text.front() == '#') {
        const std::string_view line = text.substr(1, text.find('\n') - 1);
        const std::size_t start = line.find_first_not_of(' ');
        if (start == std::string_view::npos) break;
        comment += (comment.empty() ? "" : " ") + std::string(line.substr(start));
        text.remove_prefix(std::min(text.size(), line.size() + 2));
    }
    return comment;
}

}  // namespace

std::string ShippedScene::about() const {
    const std::string comment = first_comment(text);
    for (std::size_t i = 0; i < comment.size(); ++i) {
        const bool ends = comment[i] == '.' || comment[i] == '?';
        if (ends && (i + 1 == comment.size() || comment[i + 1] == ' '))
            return comment.substr(0, comment[i] == '?' ? i + 1 : i);
    }
    return comment;
}

const ShippedScene* shipped_scene(std::string_view name, const std::vector<ShippedScene>& among) {
    const std::string plain = plain_name(name);
    const auto found = std::find_if(among.begin(), among.end(),
                                    [&](const ShippedScene& scene) { return scene.name == plain; });
    return found == among.end() ? nullptr : &*found;
}

std::vector<const ShippedScene*> shipped_scenes_with(std::string_view words,
                                                     const std::vector<ShippedScene>& among) {
    const std::string wanted = "_" + plain_name(words) + "_";
    std::vector<const ShippedScene*> matches;
    for (const ShippedScene& scene : among)
        if (("_" + scene.name + "_").find(wanted) != std::string::npos) matches.push_back(&scene);
    return matches;
}

const ShippedScene* shipped_scene_like(std::string_view words, const std::vector<ShippedScene>& among) {
    if (const ShippedScene* exact = shipped_scene(words, among)) return exact;
    const std::vector<const ShippedScene*> matches = shipped_scenes_with(words, among);
    return matches.size() == 1 ? matches.front() : nullptr;
}

// Whole names, or their beginnings and ends, word by word: "brazil_nuts" is near to the end of
// teaching_brazil_nut. Short parts are near to too much: "scene" to the beginning of cone_hopper.
std::optional<std::string> nearest_shipped_scene(std::string_view name,
                                                 const std::vector<ShippedScene>& among) {
    std::vector<std::string> parts, whole;
    constexpr std::size_t shortest_part = 6;
    const auto add = [&](const std::string& part, const std::string& of) {
        if (part != of && part.size() < shortest_part) return;
        parts.push_back(part);
        whole.push_back(of);
    };
    for (const ShippedScene& scene : among) add(scene.name, scene.name);
    for (const ShippedScene& scene : among)
        for (std::size_t at = scene.name.find('_'); at != std::string::npos;
             at = scene.name.find('_', at + 1)) {
            add(scene.name.substr(at + 1), scene.name);
            add(scene.name.substr(0, at), scene.name);
        }
    const std::optional<std::string> near = nearest_name(plain_name(name), parts);
    if (!near) return std::nullopt;
    return whole[static_cast<std::size_t>(std::find(parts.begin(), parts.end(), *near) - parts.begin())];
}

}  // namespace grainreel
