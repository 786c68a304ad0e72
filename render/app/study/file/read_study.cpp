#include "render/app/study/file/read_study.hpp"

#include <optional>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/app/study/file/read_parts.hpp"
#include "render/app/study/file/study_keys.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

// The scene with the first value of each key, for the variant that runs longest.
FilmedScene longest_scene(const Study& study) {
    std::optional<FilmedScene> longest;
    const std::size_t variants = study.has_variants() ? study.variations.front().values.size() : 1;
    for (std::size_t variant = 0; variant < variants; ++variant) {
        Assignments sets = study.sets;
        for (const Variation& variation : study.variations) {
            const Assignments more = variation.assignments(variation.key == variant_axis ? variant : 0);
            sets.insert(sets.end(), more.begin(), more.end());
        }
        FilmedScene scene = read_filmed_scene_text(study.scene_text, study.scene, sets, measurable_in);
        if (!longest || scene.run.duration > longest->run.duration) longest = std::move(scene);
    }
    return *longest;
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
    Study study;
    study.file = file;
    study.text = load_scene_file(file);
    Document document(study.text, file.string(), study_keys());
    document.check_keys();
    study.title = document.text("title").value_or(file.stem().string());
    study.scene = beside_study(study, document.required_text("scene"));
    study.scene_text = load_scene_file(study.scene);
    const std::vector<std::string> sets = document.name_list("set");
    for (std::size_t i = 0; i < sets.size(); ++i)
        study.sets.push_back({sets[i], document.place(fmt::format("set[{}]", i))});
    study.seeds = read_seeds(document, "seeds");
    read_variants(document, study);
    for (std::size_t i = 0; i < document.size("vary"); ++i)
        read_variation(document, fmt::format("vary[{}]", i), study);
    if (study.variations.empty() && study.seeds.empty())
        throw UserError(fmt::format(
            "{}:1:1: varies nothing; write [[vary]] with a key and its values, or seeds = 3", file.string()));
    const FilmedScene scene = longest_scene(study);
    for (std::size_t i = 0; i < document.size("measure"); ++i)
        read_measure(document, scene, fmt::format("measure[{}]", i), study);
    for (std::size_t i = 0; i < document.size("chart"); ++i)
        read_chart(document, fmt::format("chart[{}]", i), study);
    if (document.size("chart") == 0) add_usual_charts(study);
    document.check_all_read();
    return study;
}

}  // namespace grainreel
