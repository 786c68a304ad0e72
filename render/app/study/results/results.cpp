#include "render/app/study/results/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_json.hpp"
#include "render/app/study/results/summary.hpp"

namespace grainreel {
namespace {

using Status = MemberResult::Status;

Status status_of(const std::string& status) {
    if (status == "complete") return Status::complete;
    return status == "failed" ? Status::failed : Status::incomplete;
}

// Returns how many steps were planned; 0 where that is not known.
std::int64_t read_record(const std::filesystem::path& path, MemberResult& result) {
    const ReadRunJson read = read_run_json(path);
    result.status = status_of(read.status);
    result.error = read.record.error;
    result.warnings = read.record.warnings;
    result.simulated = read.record.simulated;
    result.settled = read.record.settled;
    result.particle_steps_per_second = read.record.particle_steps_per_second;
    result.has_film = read.record.film_frames.value_or(0) > 0;
    return read.record.steps_planned;
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

SeedValue MemberResult::seed_value(std::size_t measure) const {
    SeedValue seed;
    if (measure < values.size()) seed.value = values[measure];
    if (measure < until.size()) seed.until = until[measure];
    return seed;
}

MemberResult read_result(const std::filesystem::path& folder, const std::vector<StudyMeasure>& measures,
                         std::int64_t steps) {
    MemberResult result;
    if (!std::filesystem::exists(folder / "run.json")) return result;
    const std::int64_t planned = read_record(folder / "run.json", result);
    if (result.status == Status::complete && planned > 0 && planned < steps)
        result.status = Status::incomplete;
    result.values.assign(measures.size(), kUnknown);
    result.until = result.values;
    if (result.status != Status::complete) return result;
    const auto table = read_measures(folder / "measures.csv");
    if (table == nullptr) {
        result.status = Status::incomplete;
        return result;
    }
    const std::vector<double> times = table->all("time_s");
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const std::vector<double> values = table->all(measures[i].column);
        if (times.empty() || values.size() != times.size()) continue;
        const Reduction& how = measures[i].reduction;
        result.values[i] = reduce(how, times, values);
        if (std::isnan(result.values[i]) && how.kind == Reduction::Kind::first_passage)
            result.until[i] = last_time(how, times, values);
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

std::vector<std::string> key_headings(const Study& study) {
    std::vector<std::string> cells;
    for (const Variation& variation : study.variations) cells.push_back(heading(variation));
    return cells;
}

std::vector<std::string> key_cells(const Study& study, const Member& member) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < study.variations.size(); ++i) {
        const Variation::Value& value = study.variations[i].values[member.at[i]];
        cells.push_back(study.variations[i].numeric ? csv_number(value.number) : value.words);
    }
    return cells;
}

// The heads of the columns, in the order in which study_table() fills a row.
std::vector<std::string> header(const Study& study) {
    std::vector<std::string> cells = key_headings(study);
    if (study.has_seeds()) cells.push_back("run.seed");
    cells.push_back("state");
    for (const StudyMeasure& measure : study.measures) {
        cells.push_back(measure.name);
        if (measure.reduction.has_threshold() && measure.reduction.kind != Reduction::Kind::share)
            cells.push_back(measure.name + "_came_up");
    }
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
        std::vector<std::string> cells = key_cells(study, members[m]);
        if (study.has_seeds())
            cells.push_back(members[m].seed ? std::to_string(*members[m].seed) : std::string());
        cells.push_back(to_string(result.status));
        for (std::size_t i = 0; i < study.measures.size(); ++i) {
            const Reduction& how = study.measures[i].reduction;
            const double value = result.seed_value(i).value;
            cells.push_back(csv_number(value));
            if (!how.has_threshold() || how.kind == Reduction::Kind::share) continue;
            cells.emplace_back(result.status != Status::complete ? "" : std::isnan(value) ? "0" : "1");
        }
        cells.push_back(std::to_string(result.warnings.size()));
        cells.insert(cells.end(), {result.error, "members/" + members[m].name});
        text += row_of(cells);
    }
    return text;
}

std::string unit_table(const Study& study) {
    std::string text = "column,unit,meaning\n";
    for (const StudyMeasure& measure : study.measures)
        text += row_of({measure.name, measure.unit, measure.label});
    return text;
}

std::string setting_table(const Study& study, const std::vector<Member>& members,
                          const std::vector<MemberResult>& results) {
    std::vector<std::string> head = key_headings(study);
    head.insert(head.end(), {"members", "complete"});
    for (const StudyMeasure& measure : study.measures)
        for (const char* part : {"", "_low", "_high", "_came_up", "_at_least"})
            head.push_back(measure.name + part);
    std::string text = row_of(head);
    for (const Member& member : members) {
        if (member.seed_index > 0) continue;
        std::vector<std::string> cells = key_cells(study, member);
        cells.push_back(std::to_string(study.seed_count(member.at)));
        cells.push_back(std::to_string(setting_complete(members, results, member.setting)));
        for (std::size_t i = 0; i < study.measures.size(); ++i) {
            const SeedSummary all = setting_summary(study, members, results, member.setting, i);
            const double bound = all.is_bound ? all.of_some : SeedSummary::kNone;
            cells.insert(cells.end(), {csv_number(all.value), csv_number(all.low), csv_number(all.high),
                                       std::to_string(all.count), csv_number(bound)});
        }
        text += row_of(cells);
    }
    return text;
}

}  // namespace grainreel
