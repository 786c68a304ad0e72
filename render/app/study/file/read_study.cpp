#include "render/app/study/file/read_study.hpp"

#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/app/study/file/read_parts.hpp"
#include "render/app/study/file/study_keys.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

constexpr std::int64_t most_seeds = 100'000;

void read_seeds(Document& document, Study& study) {
    if (!document.has("seeds")) return;
    if (document.is_array("seeds")) {
        for (const std::int64_t seed : document.integer_list("seeds"))
            study.seeds.push_back(static_cast<std::uint64_t>(seed));
        if (study.seeds.empty()) document.fail("seeds", "is an empty list; write for example seeds = 3");
    } else {
        const std::int64_t count = *document.integer("seeds");
        if (count < 1 || count > most_seeds)
            document.fail("seeds",
                          fmt::format("must be a whole number from 1 to {}, or a list of seeds", most_seeds));
        for (std::int64_t seed = 1; seed <= count; ++seed)
            study.seeds.push_back(static_cast<std::uint64_t>(seed));
    }
    const std::set<std::uint64_t> different(study.seeds.begin(), study.seeds.end());
    if (different.size() < study.seeds.size()) document.fail("seeds", "has a seed twice; remove one");
}

// The scene of the first value of each key.
FilmedScene first_scene(const Study& study) {
    Assignments sets = study.sets;
    for (const Variation& variation : study.variations)
        sets.push_back({variation.key + "=" + variation.values.front().toml, variation.values.front().place});
    return read_filmed_scene_text(study.scene_text, study.scene, sets, measurable_in);
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
    read_seeds(document, study);
    for (std::size_t i = 0; i < document.size("vary"); ++i)
        read_variation(document, fmt::format("vary[{}]", i), study);
    if (study.variations.empty() && study.seeds.empty())
        throw UserError(fmt::format(
            "{}:1:1: varies nothing; write [[vary]] with a key and its values, or seeds = 3", file.string()));
    const FilmedScene scene = first_scene(study);
    for (std::size_t i = 0; i < document.size("measure"); ++i)
        read_measure(document, scene, fmt::format("measure[{}]", i), study);
    for (std::size_t i = 0; i < document.size("chart"); ++i)
        read_chart(document, fmt::format("chart[{}]", i), study);
    if (document.size("chart") == 0) add_usual_charts(study);
    document.check_all_read();
    return study;
}

}  // namespace grainreel
