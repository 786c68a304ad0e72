#include "render/app/study/results/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>

#include "engine/files/run_json.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/text/flat_toml.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

void StudyParameters::add_setting(const FilmedScene& scene, const Plan& plan) {
    if (settings_.size() == kMost) return;
    Scene plain = scene;
    plain.film_text.clear();
    auto values = flat_toml(resolved_scene(plain, plan));
    std::erase_if(values, [](const auto& value) {
        return value.first == "title" || value.first == "run.seed" || value.first == "run.threads";
    });
    settings_.push_back(std::move(values));
    if (settings_.size() > 1) return;
    RunJson record;
    static_cast<ProgramInfo&>(record) = program_info();
    record.finished = utc_now();  // BibTeX names the year
    methods_ = grainreel::methods(scene, plan, record, plan_words(scene, plan).lines);
}

std::string StudyParameters::table() const {
    const ProgramInfo program = program_info();
    std::string text = "key,value";
    for (std::size_t s = 0; s < settings_.size(); ++s) text += fmt::format(",{}", s + 1);
    const std::string nothing(settings_.size(), ',');
    const auto constant = [&](const std::string& key, const std::string& value) {
        text += fmt::format("\n{},{}{}", csv_cell(key), csv_cell(value), nothing);
    };
    constant("program.version", program.version);
    constant("program.commit", program.commit);
    constant("program.compiler", program.compiler);
    std::vector<std::string> keys;  // in the order of their first setting
    std::map<std::string, std::vector<std::string>> values;
    for (std::size_t s = 0; s < settings_.size(); ++s)
        for (const auto& [key, value] : settings_[s]) {
            std::vector<std::string>& row = values[key];
            if (row.empty()) keys.push_back(key), row.resize(settings_.size());
            row[s] = value;
        }
    for (const std::string& key : keys) {
        const std::vector<std::string>& row = values[key];
        const bool same =
            std::all_of(row.begin(), row.end(), [&](const auto& value) { return value == row[0]; });
        if (same) {
            constant(key, row[0]);
            continue;
        }
        text += fmt::format("\n{},", csv_cell(key));
        for (const std::string& value : row) text += "," + csv_cell(value);
    }
    return text + "\n";
}

Methods StudyParameters::methods(const Study& study) const {
    std::string varied;
    for (const Variation& variation : study.variations) {
        std::vector<std::string> values;
        for (const Variation::Value& value : variation.values) values.push_back(value.words);
        varied +=
            fmt::format("{}{}: {}", varied.empty() ? "" : "; ", variation.shown, fmt::join(values, ", "));
    }
    if (!study.seeds.empty())
        varied += fmt::format("{}seeds {}", varied.empty() ? "" : "; ", fmt::join(study.seeds, ", "));
    Methods all = methods_;
    all.paragraph = fmt::format(
        "Varied were {}. The numbers below are those of the first setting; parameters.csv has those of "
        "all. {}",
        varied, methods_.paragraph);
    return all;
}

}  // namespace grainreel
