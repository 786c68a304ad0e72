// Reads what a study draws: [[chart]].
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/text.hpp"
#include "render/app/study/file/read_parts.hpp"

namespace grainreel {
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
