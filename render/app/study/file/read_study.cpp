#include "render/app/study/file/read_study.hpp"

#include <fmt/format.h>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/program.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/app/study/file/variations.hpp"
#include "render/scene/filmed_scene.hpp"

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

namespace {

void check_is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw UserError(
            fmt::format("{}: there is no such file; give the path of a study (.toml)", file.string()));
}

// Refuses a scene, in which nothing is varied.
void check_no_scene(const Document& document, const std::filesystem::path& file) {
    if (document.has("scene") ||
        !(document.has("species") || document.has("container") || document.has("drive")))
        return;
    throw UserError(fmt::format("{}: this is a scene, not a study; run it by: {} movie {}", file.string(),
                                program_call(), shell_word(file.string())));
}

void read_scene_of(Document& document, Study& study) {
    const std::string name = document.required_text("scene");
    study.scene = beside_study(study, name);
    std::error_code ignored;
    if (!std::filesystem::exists(study.scene, ignored))
        document.fail("scene",
                      fmt::format("is \"{}\", but there is no such file; its path counts from the study's "
                                  "folder",
                                  excerpt(name)));
    study.scene_text = load_scene_file(study.scene);
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
    Study study;
    study.file = file;
    check_is_there(file);
    study.text = load_scene_file(file);
    Document document(study.text, file.string(), study_keys());
    check_no_scene(document, file);
    document.check_keys();
    study.title = document.text("title").value_or(file.stem().string());
    read_scene_of(document, study);
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

namespace {

using namespace keys;

constexpr double largest_seed = 9007199254740992.0;  // the largest one that run.seed takes

Keys top_level() {
    return {
        entry("title", KeyKind::text, note("the file's name"), "Above the page."),
        entry("scene", KeyKind::text, required(),
              "The scene file that is varied. Counted from the study's folder."),
        entry("set", KeyKind::name_list, note("none"),
              "Other values for keys of the scene, in every member, as after `--set`: `[\"run.duration=2 "
              "s\"]`."),
        of_dimension(
            entry("seeds", KeyKind::seeds, note("the scene's one"),
                  "Each setting is run with so many seeds, 1, 2, 3 ..., or with the seeds of a list."),
            Dimension::number, {0, largest_seed, false, false}),
    };
}

Keys of_variant() {
    return {
        entry("variant[].name", KeyKind::text, required(),
              "What tables, charts and the page call it; `--variant` runs it alone."),
        entry(
            "variant[].set", KeyKind::name_list, required(),
            "Its values for keys of the scene, which come after those of the study: "
            "`[\"container.depth=27 mm\", \"species.grains.count=9400\"]`. An empty list is the scene as it "
            "is."),
        of_dimension(entry("variant[].seeds", KeyKind::seeds, note("those of the study"),
                           "Its own seeds, so many or a list."),
                     Dimension::number, {0, largest_seed, false, false}),
    };
}

Keys of_vary() {
    return {
        entry("vary[].key", KeyKind::text, required(),
              "The key of the scene, as after `--set`: `drive.g_level`, `species.big.diameter`."),
        entry("vary[].label", KeyKind::text, note("the key"), "What charts and the page call it."),
        entry("vary[].values", KeyKind::value_list, note("none"), "Its values, one by one, or a range:"),
        entry("vary[].from", KeyKind::value, note("none"), "First value of a range."),
        entry("vary[].to", KeyKind::value, note("none"), "Last value of a range, in the same unit."),
        integer("vary[].count", 2, static_cast<double>(most_values), note("none"),
                "So many values, both ends included, or:"),
        entry("vary[].by", KeyKind::value, note("none"), "From one value to the next."),
        choice("vary[].spacing", {"linear", "logarithmic"}, literal("\"linear\""),
               "Equal distances, or equal ratios (with `count`)."),
    };
}

Keys of_measure() {
    return {
        entry("measure[].column", KeyKind::text, required(),
              "A column of measures.csv, with or without its unit: `height_difference`, `kinetic`."),
        choice("measure[].reduce",
               {"end", "mean", "slope", "crossing", "first-passage", "max", "min", "deviation"}, required(),
               "How the column becomes one number."),
        entry("measure[].name", KeyKind::text, note("`COLUMN_REDUCE`"),
              "Its column in study.csv, and what charts name it by."),
        entry("measure[].label", KeyKind::text, note("by column and `reduce`"),
              "What charts and the page call it."),
        quantity("measure[].from", Dimension::time, not_negative, literal("0"),
                 "Rows before that time do not count."),
        quantity("measure[].to", Dimension::time, positive, note("the run's end"),
                 "Rows after that time do not count."),
        quantity("measure[].threshold", Dimension::number, any, note("required for crossing, first-passage"),
                 "In the column's unit."),
    };
}

Keys of_chart() {
    return {
        entry("chart[].y", KeyKind::text, required(), "The name of a measure."),
        entry("chart[].x", KeyKind::text, note("the first numeric key"),
              "A key that is varied, or \"variant\"."),
        entry("chart[].name", KeyKind::text, note("that of `y`"), "Name of its files."),
        entry("chart[].title", KeyKind::text, note("none"), "Above the chart."),
        choice("chart[].logarithmic", {"x", "y", "both", "none"}, literal("\"none\""), "Which axes are."),
        entry("chart[].reference", KeyKind::text, note("none"),
              "A CSV file of points to be drawn on it, published ones or one's own: x, y and, when known, "
              "the error of y. "
              "Counted from the study's folder."),
        entry("chart[].reference_label", KeyKind::text, note("the file's name"),
              "What the legend calls them."),
    };
}

}  // namespace

const std::vector<Key>& study_keys() {
    static const Keys all = [] {
        Keys keys;
        for (const Keys& part : {top_level(), of_variant(), of_vary(), of_measure(), of_chart()})
            keys.insert(keys.end(), part.begin(), part.end());
        return keys;
    }();
    return all;
}

}  // namespace grainreel
