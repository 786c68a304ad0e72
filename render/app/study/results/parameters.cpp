#include "render/app/study/results/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>

#include "engine/files/run_json.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/flat_toml.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/study/file/members.hpp"
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
    first_ = {scene, plan};
}

namespace {

using Cells = std::vector<std::string>;  // a cell for each setting

// The rows of parameters.csv.
class ParameterTable {
  public:
    explicit ParameterTable(std::size_t settings) : settings_(settings) {
        text_ = "key,unit,value";
        for (std::size_t s = 0; s < settings; ++s) text_ += fmt::format(",{}", s + 1);
        text_ += ",meaning\n";
    }
    // One value for all settings.
    void constant(const std::string& key, const std::string& value, const Key* known = nullptr) {
        text_ += fmt::format("{},{},{}{},{}\n", csv_cell(key), csv_cell(unit_of(known)), csv_cell(value),
                             std::string(settings_, ','), csv_cell(meaning_of(known)));
    }
    // A value for each setting.
    void differing(const std::string& key, const std::string& unit, const Cells& row,
                   const Key* known = nullptr, const std::string& meaning = "") {
        text_ += fmt::format("{},{},", csv_cell(key), csv_cell(unit));
        for (const std::string& value : row) text_ += "," + csv_cell(value);
        text_ += fmt::format(",{}\n", csv_cell(meaning.empty() ? meaning_of(known) : meaning));
    }
    void row(const std::string& key, const Cells& row, const Key* known) {
        const bool same =
            std::all_of(row.begin(), row.end(), [&](const auto& value) { return value == row.front(); });
        same ? constant(key, row.front(), known) : differing(key, unit_of(known), row, known);
    }
    const std::string& text() const { return text_; }

    // Empty where a value has no unit, or has it written behind its number.
    static std::string unit_of(const Key* key) {
        if (key == nullptr || key->dimension == Dimension::number) return "";
        return text_of(key->dimension).unit;
    }

  private:
    static std::string meaning_of(const Key* key) {
        std::string words = key == nullptr ? "" : key->about;
        std::erase(words, '`');
        return words;
    }

    std::size_t settings_;
    std::string text_;
};

// The key of the scene that has this value; the ends of a range of diameters belong to the diameter.
const Key* key_with_value(const std::string& path) {
    const Key* key = find_key(path);
    return key != nullptr ? key : find_key(parent_of(path));
}

using Values = std::vector<std::pair<std::string, std::string>>;

// What a table of an array is called: "species.big" for "species[0]", and "contact.pair[big, wall]" for
// "contact.pair[0]".
std::map<std::string, std::string> names_of_tables(const Values& values) {
    std::map<std::string, std::string> names;
    for (const auto& [key, value] : values) {
        const std::string table = parent_of(key);
        if (name_of(key) == "name" && table.starts_with("species["))
            names[table] = "species." + value;
        else if (name_of(key) == "between" && table.ends_with(']'))
            names[table] = table.substr(0, table.rfind('[')) + value;
    }
    return names;
}

std::string named(const std::string& key, const std::map<std::string, std::string>& names) {
    for (const auto& [table, name] : names)
        if (key.starts_with(table + ".")) return name + key.substr(table.size());
    return key;
}

// The settings by their names, what was varied, and the seeds.
void add_what_was_varied(const Study& study, std::size_t settings, ParameterTable& table) {
    Cells names(settings), seeds(settings);
    std::vector<Cells> values(study.variations.size(), Cells(settings));
    for (std::size_t s = 0; s < settings; ++s) {
        const Member setting = setting_of(study, s);
        names[s] = shown_setting(study, setting);
        seeds[s] = fmt::format("{}", fmt::join(study.seeds_of(setting.at), ", "));
        for (std::size_t i = 0; i < values.size(); ++i) {
            const Variation& variation = study.variations[i];
            const Variation::Value& value = variation.values[setting.at[i]];
            values[i][s] = variation.numeric ? csv_number(value.number) : value.words;
        }
    }
    table.differing("setting", "", names);
    for (std::size_t i = 0; i < values.size(); ++i)
        table.differing(study.variations[i].key, study.variations[i].unit, values[i]);
    if (study.has_seeds()) table.row("run.seed", seeds, nullptr);
}

// For how long the beds settled, of each seed of a setting that has run.
void add_settling(std::size_t settings, const std::vector<Member>& members,
                  const std::vector<MemberResult>& results, ParameterTable& table) {
    Cells settled(settings);
    for (std::size_t i = 0; i < members.size() && i < results.size(); ++i) {
        if (members[i].setting >= settings || !results[i].settled) continue;
        std::string& cell = settled[members[i].setting];
        cell += fmt::format("{}{:.6g}", cell.empty() ? "" : ", ", *results[i].settled);
    }
    if (std::all_of(settled.begin(), settled.end(), [](const auto& cell) { return cell.empty(); })) return;
    table.differing("packing.settled", "s", settled, nullptr,
                    "Simulated time for which the bed settled before the drive, of each seed");
}

}  // namespace

std::string StudyParameters::table(const Study& study, const std::vector<Member>& members,
                                   const std::vector<MemberResult>& results) const {
    const ProgramInfo program = program_info();
    ParameterTable table(settings_.size());
    add_what_was_varied(study, settings_.size(), table);
    table.constant("program.version", program.version);
    table.constant("program.commit", program.commit);
    table.constant("program.compiler", program.compiler);
    add_settling(settings_.size(), members, results, table);
    std::vector<std::string> keys;  // in the order of their first setting
    std::map<std::string, Cells> values;
    std::map<std::string, const Key*> known;
    for (std::size_t s = 0; s < settings_.size(); ++s) {
        const auto names = names_of_tables(settings_[s]);
        for (const auto& [path, value] : settings_[s]) {
            const std::string key = named(path, names);
            Cells& row = values[key];
            if (row.empty()) keys.push_back(key), row.resize(settings_.size());
            row[s] = value;
            known.emplace(key, key_with_value(path));
        }
    }
    for (const Variation& variation : study.variations)
        std::erase(keys, variation.key);  // those stand on top
    for (const std::string& key : keys) table.row(key, values[key], known[key]);
    return table.text();
}

namespace {

// What is made of a column, "{0}", with its threshold, "{1}".
const char* words_of(Reduction::Kind kind) {
    switch (kind) {
        case Reduction::Kind::end:
            return "the last value of {0}";
        case Reduction::Kind::mean:
            return "the mean of {0} over time";
        case Reduction::Kind::slope:
            return "the slope of the line of least squares of {0} against time";
        case Reduction::Kind::crossing:
            return "the time at which {0} passes {1} for the last time";
        case Reduction::Kind::first_passage:
            return "the time at which {0} first reaches {1}";
        case Reduction::Kind::max:
            return "the largest value of {0}";
        case Reduction::Kind::min:
            return "the smallest value of {0}";
        case Reduction::Kind::deviation:
            return "the standard deviation of {0} over time";
        case Reduction::Kind::share:
            break;
    }
    return "the share of runs in which {0} reaches {1}";
}

// "rise: the mean of height_difference over time, from 2.5 s to 6 s"
std::string measure_text(const StudyMeasure& measure, double duration) {
    const Reduction& how = measure.reduction;
    const std::string& unit = measure.column_unit;
    const std::string threshold = fmt::format("{:.6g}{}{}", how.threshold, unit.empty() ? "" : " ", unit);
    return fmt::format("{}: {}, from {:.6g} s to {:.6g} s", measure.title(),
                       fmt::format(fmt::runtime(words_of(how.kind)), measure.column, threshold), how.from,
                       std::min(how.to, duration));
}

std::string averages_text(const Study& study) {
    std::string text;
    if (!study.has_intervals())
        return " Each setting was run with one seed, so means and medians have no interval.";
    if (study.joins_by(SeedAverage::mean))
        text +=
            " Values are means over the seeds; intervals are 95 % confidence intervals of the mean by "
            "Student's t.";
    if (study.joins_by(SeedAverage::median))
        text +=
            " Medians over the seeds have 95 % intervals by order statistics (from six seeds on); a passage "
            "that "
            "did not come up counts as later than the end of the run.";
    if (study.joins_by(SeedAverage::share)) text += " Shares have Wilson's 95 % interval.";
    return text;
}

std::string list_of_seeds(const Seeds& seeds) {
    return fmt::format("seed{} {}", seeds.size() == 1 ? "" : "s", fmt::join(seeds, ", "));
}

// What was varied, a sentence for all keys; a search tells its range and method.
std::string varied_text(const Study& study) {
    if (study.search) {
        const Variation& key = study.variations.front();
        return fmt::format(
            "The value of {} at which {} was searched between {} and {} by bisection, to within {:.6g}{}{}.",
            key.shown, study.search->words, key.values.front().words, key.values.back().words,
            study.search->within, study.search->written_unit.empty() ? "" : " ", study.search->written_unit);
    }
    std::string varied;
    for (const Variation& variation : study.variations) {
        std::vector<std::string> values;
        for (const Variation::Value& value : variation.values) values.push_back(value.words);
        varied +=
            fmt::format("{}{} ({})", varied.empty() ? "" : " and ", variation.shown, fmt::join(values, ", "));
    }
    if (varied.empty()) return "";
    return fmt::format("{} {} varied.", varied, study.variations.size() == 1 ? "was" : "were");
}

}  // namespace

Methods StudyParameters::methods(const Study& study, const std::string& stiffness) const {
    if (!first_) return {};
    const auto& [scene, plan] = *first_;
    RunJson record;
    static_cast<ProgramInfo&>(record) = program_info();
    record.finished = utc_now();  // BibTeX names the year
    const Seeds& seeds = study.has_variants() ? study.variations.front().values.front().seeds : study.seeds;
    const Seeds& first_seeds = seeds.empty() ? study.seeds : seeds;
    Methods all = grainreel::methods(scene, plan, record, plan_words(scene, plan).lines,
                                     first_seeds.empty() ? "" : list_of_seeds(first_seeds));
    std::string text = varied_text(study);
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    if (!study.seeds.empty())
        text += fmt::format("{}Each setting was run with the {}.", text.empty() ? "" : " ",
                            list_of_seeds(study.seeds));
    if (count_settings(study) > 1)
        text +=
            " Where settings differ, the numbers below are those of the first one; parameters.csv has all.";
    text += " " + all.paragraph;
    for (std::size_t i = 0; i < study.measures.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? " Measured were " : "; ",
                            measure_text(study.measures[i], scene.run.duration));
    if (!study.measures.empty()) text += ".";
    if (!study.measures.empty()) text += averages_text(study);
    if (!stiffness.empty()) text += fmt::format(" The stiffness is {}.", stiffness);
    all.paragraph = text;
    return all;
}

}  // namespace grainreel
