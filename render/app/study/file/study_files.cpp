#include "render/app/study/file/study_files.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::string advice_for_missing(const std::string& name) {
    std::string several;
    for (const ShippedScene* study : shipped_scenes_with(name, shipped_studies()))
        several += (several.empty() ? "" : ", ") + study->name;
    if (!several.empty()) return "several shipped studies have this in their names: " + several;
    const auto meant = nearest_shipped_scene(name, shipped_studies());
    return meant ? fmt::format("did you mean the shipped study '{}'?", *meant)
                 : "give the path of a study (.toml)";
}

}  // namespace

void read_study_text(const fs::path& file, Study& study) {
    std::error_code ignored;
    study.file = file;
    if (!fs::exists(file, ignored)) {
        const std::string name = file.filename().string();
        const ShippedScene* const shipped =
            file.has_parent_path() ? nullptr : shipped_scene_like(name, shipped_studies());
        if (shipped == nullptr)
            throw UserError(
                fmt::format("{}: there is no such file; {}", file.string(), advice_for_missing(name)));
        study.shipped = true;
        study.file = shipped->name + ".toml";
        study.text = shipped->text;
        return;
    }
    study.text = load_scene_file(file);
}

NamedText file_of_study(const Study& study, const std::string& name) {
    if (study.shipped) {
        const fs::path file = fs::path(name).filename();
        if (const ShippedScene* scene = shipped_scene(file.string())) return {std::string(scene->text), file};
        for (const ShippedScene& table : shipped_tables())
            if (table.name == file) return {std::string(table.text), file};
        return {};
    }
    const fs::path file = (study.file.parent_path() / name).lexically_normal();
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    return {load_scene_file(file), file};
}

}  // namespace grainreel
