// Reads what a study measures, [[measure]], and which charts it draws, [[chart]].

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <optional>

#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/chapters/words.hpp"
#include "render/app/study/file/read_study.hpp"
#include "render/scene/live_text.hpp"

namespace grainreel {
namespace {

const ChoiceWords<Reduction::Kind> reduction_words{{"end", Reduction::Kind::end},
                                                   {"mean", Reduction::Kind::mean},
                                                   {"slope", Reduction::Kind::slope},
                                                   {"crossing", Reduction::Kind::crossing},
                                                   {"first-passage", Reduction::Kind::first_passage},
                                                   {"max", Reduction::Kind::max},
                                                   {"min", Reduction::Kind::min},
                                                   {"deviation", Reduction::Kind::deviation}};

void read_window(Document& document, const FilmedScene& scene, const std::string& table,
                 Reduction& reduction) {
    reduction.from = document.quantity(table + ".from").value_or(reduction.from);
    reduction.to = document.quantity(table + ".to").value_or(reduction.to);
    if (reduction.from >= reduction.to)
        document.fail(table + ".to", "must be later than 'from'; exchange them or widen the window");
    if (reduction.from > scene.run.duration)
        document.fail(table + ".from",
                      fmt::format("is {:.6g} s, but the run ends at {:.6g} s; make it earlier",
                                  reduction.from, scene.run.duration));
}

void read_threshold(Document& document, const std::string& table, const MeasureColumn& column,
                    Reduction& reduction) {
    const std::string path = table + ".threshold";
    const bool wanted =
        reduction.kind == Reduction::Kind::crossing || reduction.kind == Reduction::Kind::first_passage;
    if (!wanted) return document.refuse(path, "only 'crossing' and 'first-passage' have a threshold");
    if (!document.has(path)) document.fail_missing(path);
    reduction.threshold = *document.quantity(path, column.dimension);
}

// The unit of what a column is reduced to; empty for a pure number.
std::string unit_of(const MeasureColumn& column, Reduction::Kind kind) {
    const std::string of_column = text_of(column.dimension).unit;
    if (kind == Reduction::Kind::crossing || kind == Reduction::Kind::first_passage) return "s";
    if (kind == Reduction::Kind::slope) return of_column + "/s";
    return of_column == "1" ? "" : of_column;
}

}  // namespace

void read_measure(Document& document, const FilmedScene& scene, const std::string& table, Study& study) {
    const std::vector<MeasureColumn> columns = measure_columns(scene);
    StudyMeasure measure;
    const std::string name = document.required_text(table + ".column");
    const MeasureColumn* column = find_column(columns, name);
    if (column == nullptr)
        document.fail(table + ".column",
                      fmt::format("must be a column of measures.csv, but is \"{}\"; there are {}",
                                  excerpt(name), column_names(columns)));
    measure.column = column->name;
    const std::string how = document.required_text(table + ".reduce");
    for (const auto& [word, kind] : reduction_words)
        if (word == how) measure.reduction.kind = kind;
    measure.name = document.text(table + ".name").value_or(name + "_" + how);
    measure.label = document.text(table + ".label").value_or(fmt::format("{}, {}", column->label, how));
    measure.unit = unit_of(*column, measure.reduction.kind);
    measure.place = document.place(table + ".column");
    for (const StudyMeasure& other : study.measures)
        if (other.name == measure.name)
            document.fail(document.has(table + ".name") ? table + ".name" : table + ".column",
                          fmt::format("gives a second measure the name \"{}\"; give one another 'name'",
                                      excerpt(measure.name)));
    read_window(document, scene, table, measure.reduction);
    read_threshold(document, table, *column, measure.reduction);
    study.measures.push_back(std::move(measure));
}

// From here on: reading [[chart]].

namespace {

std::size_t index_of_measure(const Document& document, const Study& study, const std::string& path,
                             const std::string& name) {
    std::vector<std::string> names;
    for (const StudyMeasure& measure : study.measures) names.push_back(measure.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        document.fail(
            path, fmt::format("must be the name of a [[measure]], but is \"{}\"; there are {}", excerpt(name),
                              names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t index_of_variation(const Document& document, const Study& study, const std::string& path,
                               const std::string& key) {
    std::vector<std::string> keys;
    for (const Variation& variation : study.variations) keys.push_back(variation.key);
    const auto found = std::find(keys.begin(), keys.end(), key);
    if (found == keys.end())
        document.fail(path, fmt::format("must be a key that is varied, but is \"{}\"; there are {}",
                                        excerpt(key), fmt::join(keys, ", ")));
    return static_cast<std::size_t>(found - keys.begin());
}

std::size_t usual_x(const Study& study) {
    for (std::size_t i = 0; i < study.variations.size(); ++i)
        if (study.variations[i].numeric) return i;
    return 0;
}

void check_axis(const Document& document, const Study& study, const std::string& table,
                const StudyChart& chart) {
    const Variation& x = study.variations[chart.x];
    if (!chart.log_x) return;
    for (const Variation::Value& value : x.values)
        if (!x.numeric || value.number <= 0)
            document.fail(
                table + ".logarithmic",
                fmt::format("wants an x axis of numbers larger than 0, but {} has {}; leave 'x' out of it",
                            excerpt(x.key), excerpt(value.words)));
}

void read_reference(Document& document, const Study& study, const std::string& table, StudyChart& chart) {
    const auto file = document.text(table + ".reference");
    if (!file) return document.refuse(table + ".reference_label", "there is no 'reference'");
    if (!study.variations[chart.x].numeric)
        document.fail(table + ".reference",
                      "needs an x axis of numbers; vary a key that has them, or remove it");
    chart.reference = beside_study(study, *file);
    if (!std::filesystem::is_regular_file(*chart.reference))
        document.fail(table + ".reference",
                      fmt::format("is \"{}\", but there is no such file; its path counts from "
                                  "the study's folder",
                                  excerpt(*file)));
    chart.reference_label =
        document.text(table + ".reference_label").value_or(chart.reference->filename().string());
}

void add_chart(const Document& document, const std::string& table, StudyChart chart, Study& study) {
    for (const StudyChart& other : study.charts)
        if (other.name == chart.name)
            document.fail(
                document.has(table + ".name") ? table + ".name" : table + ".y",
                fmt::format("makes a second chart \"{}\"; give one another 'name'", excerpt(chart.name)));
    study.charts.push_back(std::move(chart));
}

}  // namespace

void read_chart(Document& document, const std::string& table, Study& study) {
    StudyChart chart;
    if (study.variations.empty())
        document.fail(table, "needs a key on its x axis, but the study varies none; add [[vary]]");
    chart.y = index_of_measure(document, study, table + ".y", document.required_text(table + ".y"));
    chart.x = usual_x(study);
    if (const auto key = document.text(table + ".x"))
        chart.x = index_of_variation(document, study, table + ".x", *key);
    chart.name = document.text(table + ".name").value_or(study.measures[chart.y].name);
    chart.title = document.text(table + ".title").value_or("");
    const std::string logarithmic = document.text(table + ".logarithmic").value_or("none");
    chart.log_x = logarithmic == "x" || logarithmic == "both";
    chart.log_y = logarithmic == "y" || logarithmic == "both";
    check_axis(document, study, table, chart);
    read_reference(document, study, table, chart);
    add_chart(document, table, std::move(chart), study);
}

void add_usual_charts(Study& study) {
    if (study.variations.empty()) return;
    for (std::size_t y = 0; y < study.measures.size(); ++y) {
        StudyChart chart;
        chart.name = study.measures[y].name;
        chart.x = usual_x(study);
        chart.y = y;
        study.charts.push_back(std::move(chart));
    }
}

}  // namespace grainreel
