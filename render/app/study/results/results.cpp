#include "render/app/study/results/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/files/measures_csv.hpp"
#include "engine/files/run_json.hpp"

namespace grainreel {
namespace {

using Status = MemberResult::Status;

Status status_of(const std::string& status) {
    if (status == "complete") return Status::complete;
    return status == "failed" ? Status::failed : Status::incomplete;
}

void read_record(const std::filesystem::path& path, MemberResult& result) {
    const ReadRunJson read = read_run_json(path);
    result.status = status_of(read.status);
    result.error = read.record.error;
    result.warnings = read.record.warnings;
    result.simulated = read.record.simulated;
    result.particle_steps_per_second = read.record.particle_steps_per_second;
    result.has_film = read.record.film_frames.value_or(0) > 0;
}

}  // namespace

std::string to_string(Status status) {
    switch (status) {
        case Status::missing:
            return "missing";
        case Status::incomplete:
            return "incomplete";
        case Status::failed:
            return "failed";
        case Status::complete:
            break;
    }
    return "complete";
}

MemberResult read_result(const std::filesystem::path& folder, const std::vector<StudyMeasure>& measures) {
    MemberResult result;
    if (!std::filesystem::exists(folder / "run.json")) return result;
    read_record(folder / "run.json", result);
    result.values.assign(measures.size(), std::numeric_limits<double>::quiet_NaN());
    if (result.status != Status::complete) return result;
    const auto table = read_measures(folder / "measures.csv");
    if (table == nullptr) {
        result.status = Status::incomplete;
        return result;
    }
    const std::vector<double> times = table->all("time_s");
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const std::vector<double> values = table->all(measures[i].column);
        if (!times.empty() && values.size() == times.size())
            result.values[i] = reduce(measures[i].reduction, times, values);
    }
    return result;
}

namespace {

std::string row_of(std::vector<std::string> cells) {
    for (std::string& cell : cells) cell = csv_cell(cell);
    return fmt::format("{}\n", fmt::join(cells, ","));
}

std::string heading(const Variation& variation) {
    return variation.unit.empty() ? variation.key : fmt::format("{} [{}]", variation.key, variation.unit);
}

// The heads of the columns, in the order in which study_table() fills a row.
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
        cells.push_back(to_string(result.status));
        for (std::size_t i = 0; i < study.measures.size(); ++i)
            cells.push_back(i < result.values.size() ? csv_number(result.values[i]) : "");
        cells.push_back(std::to_string(result.warnings.size()));
        cells.insert(cells.end(), {result.error, "members/" + members[m].name});
        text += row_of(cells);
    }
    return text;
}

}  // namespace grainreel
