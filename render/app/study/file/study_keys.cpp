// The keys of a study file: their names, values, defaults and meanings.
#include "engine/scene/keys/keys.hpp"
#include "render/app/study/file/read_study.hpp"
#include "render/app/study/file/variations.hpp"

namespace grainreel {
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
        choice(
            "stiffness", {"shared", "own"}, literal("\"shared\""),
            "Where the plan chooses the stiffness of a contact: that of the stiffest member for all, so that "
            "all are of one material, or for each its own."),
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
        entry(
            "vary[].until", KeyKind::text, note("none"),
            "Finds the value between `from` and `to` at which a measure has this value, `\"angle = 24\"`, by "
            "bisection."),
        entry("vary[].within", KeyKind::value, note("required with `until`"),
              "How narrow the bracket of that value is to become."),
        choice("vary[].spacing", {"linear", "logarithmic"}, literal("\"linear\""),
               "Equal distances, or equal ratios (with `count`)."),
    };
}

Keys of_measure() {
    return {
        entry("measure[].column", KeyKind::text, required(),
              "A column of measures.csv, with or without its unit: `height_difference`, `kinetic`."),
        choice("measure[].reduce",
               {"end", "mean", "slope", "crossing", "first-passage", "max", "min", "deviation", "share"},
               required(), "How the column becomes one number."),
        choice("measure[].average", {"mean", "median"}, literal("\"mean\""),
               "What the seeds of a setting are joined to. The median is known while fewer than half of the "
               "passages did not come up."),
        entry("measure[].name", KeyKind::text, note("`COLUMN_REDUCE`"),
              "Its column in study.csv, and what charts name it by."),
        entry("measure[].label", KeyKind::text, note("by column and `reduce`"),
              "What charts and the page call it."),
        quantity("measure[].from", Dimension::time, not_negative, literal("0"),
                 "Rows before that time do not count."),
        quantity("measure[].to", Dimension::time, positive, note("the run's end"),
                 "Rows after that time do not count."),
        quantity("measure[].threshold", Dimension::number, any,
                 note("required for crossing, first-passage, share"), "In the column's unit."),
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
        entry("chart[].x_label", KeyKind::text, note("that of the key"), "What stands below the x axis."),
        entry("chart[].y_label", KeyKind::text, note("that of the measure"),
              "What stands beside the y axis."),
        entry("chart[].x_range", KeyKind::value_list, note("by the points"),
              "Where the x axis begins and ends, in its unit: `[0, 6]`."),
        entry("chart[].y_range", KeyKind::value_list, note("by the points"), "The same for the y axis."),
        entry(
            "chart[].x_per", KeyKind::value, note("none"),
            "x is divided by this value, in the unit of the key: `\"2 mm\"` makes d/d0 of d. A reference has "
            "x divided already."),
        entry("chart[].series", KeyKind::name_list, note("all"),
              "Which series are drawn, in this order, by the names that the legend has: `[\"d of nut = 9 "
              "mm\"]`."),
        entry("chart[].font", KeyKind::text, literal("\"DejaVu Sans\""), "The font of its letters."),
        quantity("chart[].letters", Dimension::number, {4, 24, false, false}, literal("8"),
                 "Height of its letters in points, on paper; on the screen they grow with it."),
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
