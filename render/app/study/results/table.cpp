#include "render/app/study/results/table.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grainreel {
namespace {

std::string row_of(std::vector<std::string> cells) {
    for (std::string& cell : cells) cell = csv_cell(cell);
    return fmt::format("{}\n", fmt::join(cells, ","));
}

std::string heading(const Variation& variation) {
    return variation.unit.empty() ? variation.key : fmt::format("{} [{}]", variation.key, variation.unit);
}

std::vector<std::string> header(const Study& study) {
    std::vector<std::string> cells;
    for (const Variation& variation : study.variations) cells.push_back(heading(variation));
    if (study.has_seeds()) cells.push_back("run.seed");
    cells.push_back("state");
    for (const StudyMeasure& measure : study.measures) cells.push_back(measure.name);
    cells.insert(cells.end(), {"warnings", "error", "folder"});
    return cells;
}

}  // namespace

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
    return cell + "\"";
}

std::string csv_number(double value) {
    return std::isnan(value) ? "" : fmt::format("{}", value);
}

std::string study_table(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results) {
    std::string text = row_of(header(study));
    for (std::size_t m = 0; m < members.size(); ++m) {
        const MemberResult& result = results[m];
        std::vector<std::string> cells;
        for (std::size_t i = 0; i < study.variations.size(); ++i) {
            const Variation& variation = study.variations[i];
            const Variation::Value& value = variation.values[members[m].at[i]];
            cells.push_back(variation.numeric ? csv_number(value.number) : value.words);
        }
        if (study.has_seeds())
            cells.push_back(members[m].seed ? std::to_string(*members[m].seed) : std::string());
        cells.push_back(to_string(result.state));
        for (std::size_t i = 0; i < study.measures.size(); ++i)
            cells.push_back(i < result.values.size() ? csv_number(result.values[i]) : "");
        cells.push_back(std::to_string(result.warnings.size()));
        cells.insert(cells.end(), {result.error, "members/" + members[m].name});
        text += row_of(cells);
    }
    return text;
}

}  // namespace grainreel
