#include "render/app/study/file/read_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/app/study/file/study_files.hpp"
#include "render/app/study/file/variations.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/live_text.hpp"

namespace grainreel {
namespace {

// Reads what a study measures, [[measure]].

const ChoiceWords<Reduction::Kind> reduction_words{{"end", Reduction::Kind::end},
                                                   {"mean", Reduction::Kind::mean},
                                                   {"slope", Reduction::Kind::slope},
                                                   {"crossing", Reduction::Kind::crossing},
                                                   {"first-passage", Reduction::Kind::first_passage},
                                                   {"max", Reduction::Kind::max},
                                                   {"min", Reduction::Kind::min},
                                                   {"deviation", Reduction::Kind::deviation},
                                                   {"share", Reduction::Kind::share}};

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
    if (!reduction.has_threshold())
        return document.refuse(path, "only 'crossing', 'first-passage' and 'share' have a threshold");
    if (!document.has(path)) document.fail_missing(path);
    reduction.threshold = *document.quantity(path, column.dimension);
}

// The unit of what a column is reduced to; empty for a pure number.
std::string unit_of(const MeasureColumn& column, Reduction::Kind kind) {
    const std::string of_column = text_of(column.dimension).unit;
    if (kind == Reduction::Kind::crossing || kind == Reduction::Kind::first_passage) return "s";
    if (kind == Reduction::Kind::share) return "";
    if (kind == Reduction::Kind::slope) return of_column + "/s";
    return of_column == "1" ? "" : of_column;
}

// What charts and the page call a measure that has no label.
std::string usual_label(const MeasureColumn& column, const Reduction& how, const std::string& word) {
    const std::string unit = text_of(column.dimension).unit;
    const std::string threshold =
        fmt::format("{:.4g}{}", how.threshold, unit.empty() || unit == "1" ? "" : " " + unit);
    switch (how.kind) {
        case Reduction::Kind::share:
            return fmt::format("share of runs that reach {}: {}", threshold, column.label);
        case Reduction::Kind::first_passage:
            return fmt::format("time of first reaching {}: {}", threshold, column.label);
        case Reduction::Kind::crossing:
            return fmt::format("time of last passing {}: {}", threshold, column.label);
        default:
            return fmt::format("{}, {}", column.label, word);
    }
}

bool cannot_be_negative(const FilmedScene& scene, const MeasureColumn& column, Reduction::Kind kind) {
    using Kind = Reduction::Kind;
    if (kind == Kind::crossing || kind == Kind::first_passage || kind == Kind::deviation) return true;
    return kind != Kind::slope && axis_of_column(scene, column.name).from_zero;
}

// scene: that of the variant that runs longest. All members have its species and so its columns.
void read_measure(Document& document, const FilmedScene& scene, const std::string& table, Study& study) {
    const std::vector<MeasureColumn> columns = measure_columns(scene);
    StudyMeasure measure;
    const std::string name = document.required_text(table + ".column");
    const MeasureColumn* column = find_column(columns, name);
    if (column == nullptr) {
        std::vector<std::string> names;
        for (const MeasureColumn& one : columns) names.push_back(one.name);
        const auto meant = nearest_name(name, names);
        document.fail(
            table + ".column",
            fmt::format("must be a column of measures.csv, but is \"{}\"; {}there are {}", excerpt(name),
                        meant ? fmt::format("did you mean '{}'? ", *meant) : "", column_names(columns)));
    }
    measure.column = column->name;
    const std::string how = document.required_text(table + ".reduce");
    for (const auto& [word, kind] : reduction_words)
        if (word == how) measure.reduction.kind = kind;
    measure.name = document.text(table + ".name").value_or(name + "_" + how);
    if (measure.reduction.kind == Reduction::Kind::share) measure.average = SeedAverage::share;
    if (document.text(table + ".average") == "median") {
        if (measure.average == SeedAverage::share)
            document.fail(table + ".average", "is of no use for 'share', a share of the seeds; leave it out");
        measure.average = SeedAverage::median;
    }
    measure.unit = unit_of(*column, measure.reduction.kind);
    measure.column_unit = unit_of(*column, Reduction::Kind::end);
    measure.from_zero = cannot_be_negative(scene, *column, measure.reduction.kind);
    measure.place = document.place(table + ".column");
    for (const StudyMeasure& other : study.measures)
        if (other.name == measure.name)
            document.fail(document.has(table + ".name") ? table + ".name" : table + ".column",
                          fmt::format("gives a second measure the name \"{}\"; give one another 'name'",
                                      excerpt(measure.name)));
    read_window(document, scene, table, measure.reduction);
    read_threshold(document, table, *column, measure.reduction);
    measure.label = document.text(table + ".label").value_or(usual_label(*column, measure.reduction, how));
    study.measures.push_back(std::move(measure));
}

// Reads which charts a study draws, [[chart]].

std::size_t index_of_measure(const Document& document, const Study& study, const std::string& path,
                             const std::string& name) {
    std::vector<std::string> names;
    for (const StudyMeasure& measure : study.measures) names.push_back(measure.name);
    const std::optional<std::size_t> place = place_in(names, name);
    if (!place)
        document.fail(
            path, fmt::format("must be the name of a [[measure]], but is \"{}\"; there are {}", excerpt(name),
                              names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    return *place;
}

std::size_t index_of_variation(const Document& document, const Study& study, const std::string& path,
                               const std::string& key) {
    std::vector<std::string> keys;
    for (const Variation& variation : study.variations) keys.push_back(variation.key);
    const std::optional<std::size_t> place = place_in(keys, key);
    if (!place)
        document.fail(path, fmt::format("must be a key that is varied, but is \"{}\"; there are {}",
                                        excerpt(key), fmt::join(keys, ", ")));
    return *place;
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
    const NamedText table_of_points = file_of_study(study, *file);
    chart.reference = table_of_points.file;
    chart.reference_text = table_of_points.text;
    if (chart.reference->empty())
        document.fail(table + ".reference",
                      fmt::format("is \"{}\", but there is no such file; its path counts from "
                                  "the study's folder",
                                  excerpt(*file)));
    chart.reference_label =
        document.text(table + ".reference_label").value_or(chart.reference->filename().string());
}

// Two numbers in the unit of an axis: [0, 12], or ["0 mm", "12 mm"].
std::optional<std::array<double, 2>> read_axis_range(Document& document, const std::string& path,
                                                     const std::string& unit, bool logarithmic) {
    if (!document.has(path)) return std::nullopt;
    std::vector<double> ends;
    for (const std::string& text : document.value_list(path)) {
        const auto value = written_number(text);
        if (!value || !std::isfinite(value->number) || (!value->unit.empty() && value->unit != unit))
            document.fail(path, fmt::format("must be two numbers{}, such as [0, 1]",
                                            unit.empty() ? "" : " in " + unit + ", the axis' unit"));
        ends.push_back(value->number);
    }
    if (ends.size() != 2 || !(ends[0] < ends[1]) || (logarithmic && ends[0] <= 0))
        document.fail(path,
                      fmt::format("must be two numbers, the smaller one first{}; write for example [{}, 10]",
                                  logarithmic ? " and larger than 0" : "", logarithmic ? 1 : 0));
    return {{ends[0], ends[1]}};
}

void read_x_per(Document& document, const Variation& x, const std::string& path, StudyChart& chart) {
    if (!document.has(path)) return;
    if (!x.numeric) document.fail(path, "divides the numbers along x, but x has words; leave it out");
    const auto value = written_number(document.value(path));
    if (!value || !(value->number > 0) || !std::isfinite(value->number) ||
        (!value->unit.empty() && value->unit != x.unit))
        document.fail(path, fmt::format("must be a number larger than 0{}, by which x is divided",
                                        x.unit.empty() ? "" : " in " + x.unit + ", the axis' unit"));
    chart.x_per = value->number;
    chart.x_per_words = fmt::format("{:.6g}{}{}", value->number, x.unit.empty() ? "" : " ", x.unit);
}

// How the chart looks: labels, ranges, letters.
void read_look(Document& document, const Study& study, const std::string& table, StudyChart& chart) {
    const Variation& x = study.variations[chart.x];
    chart.x_label = document.text(table + ".x_label").value_or("");
    chart.y_label = document.text(table + ".y_label").value_or("");
    read_x_per(document, x, table + ".x_per", chart);
    if (document.has(table + ".x_range") && !x.numeric)
        document.fail(table + ".x_range", "is of numbers, but x has words; leave it out");
    const std::string x_unit = unit_of_x(study, chart).unit;
    chart.x_range =
        read_axis_range(document, table + ".x_range", chart.x_per_words.empty() ? x_unit : "", chart.log_x);
    chart.y_range = read_axis_range(document, table + ".y_range", unit_of_y(study, chart).unit, chart.log_y);
    chart.series = document.name_list(table + ".series");
    if (!chart.series.empty()) chart.series_place = document.place(table + ".series");
    chart.font = document.text(table + ".font").value_or(chart.font);
    const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == ' ' || c == '-'; };
    if (chart.font.empty() || !std::all_of(chart.font.begin(), chart.font.end(), is_plain))
        document.fail(table + ".font", "must be the name of a font, of letters, digits and spaces");
    chart.letters = document.quantity(table + ".letters").value_or(chart.letters);
}

void add_chart(const Document& document, const std::string& table, StudyChart chart, Study& study) {
    for (const StudyChart& other : study.charts)
        if (other.name == chart.name)
            document.fail(
                document.has(table + ".name") ? table + ".name" : table + ".y",
                fmt::format("makes a second chart \"{}\"; give one another 'name'", excerpt(chart.name)));
    study.charts.push_back(std::move(chart));
}

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
    read_look(document, study, table, chart);
    read_reference(document, study, table, chart);
    add_chart(document, table, std::move(chart), study);
}

// Adds a chart for each measure when the file asks for none.
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

// Refuses a scene, in which nothing is varied.
void check_no_scene(const Document& document, const std::filesystem::path& file) {
    if (document.has("scene") ||
        !(document.has("species") || document.has("container") || document.has("drive")))
        return;
    throw UserError("{}: this is a scene, not a study; run it by: {} movie {}", file.string(), program_call(),
                    shell_word(file.string()));
}

void read_scene_of(Document& document, Study& study) {
    const std::string name = document.required_text("scene");
    const NamedText scene = file_of_study(study, name);
    if (scene.file.empty())
        document.fail("scene",
                      fmt::format("is \"{}\", but there is no such file; its path counts from the study's "
                                  "folder",
                                  excerpt(name)));
    study.scene = scene.file;
    study.scene_text = scene.text;
}

// Finds the measure that `until` names, and the wanted value: "angle = 24".
void complete_search(Study& study) {
    StudySearch& search = *study.search;
    const auto fail = [&](const std::string& what) {
        throw UserError("{}: 'until' is \"{}\", {}", search.place, excerpt(search.words), what);
    };
    if (study.variations.size() != 1)
        fail("but a search has one [[vary]] and no [[variant]]; take the others out");
    const auto trimmed = [](std::string text) {
        text.erase(0, text.find_first_not_of(' '));
        return text.erase(text.find_last_not_of(' ') + 1);
    };
    const std::size_t equals = search.words.find('=');
    if (equals == std::string::npos) fail("but must be a measure and its value, such as \"angle = 24\"");
    const std::string name = trimmed(search.words.substr(0, equals));
    const auto value = written_number(quoted(trimmed(search.words.substr(equals + 1))));
    std::vector<std::string> names;
    for (const StudyMeasure& measure : study.measures) names.push_back(measure.name);
    const std::optional<std::size_t> place = place_in(names, name);
    if (!place)
        fail(fmt::format("but there is no [[measure]] \"{}\"; there are {}", excerpt(name),
                         names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    search.measure = *place;
    const std::string& unit = study.measures[search.measure].unit;
    if (!value || !std::isfinite(value->number) || (!value->unit.empty() && value->unit != unit))
        fail(fmt::format("but the value must be a number{}", unit.empty() ? "" : " in " + unit));
    search.wanted = value->number;
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
    Study study;
    read_study_text(file, study);
    Document document(study.text, study.file.string(), study_keys());
    check_no_scene(document, study.file);
    document.check_keys();
    study.title = document.text("title").value_or(study.file.stem().string());
    read_scene_of(document, study);
    const std::vector<std::string> sets = document.name_list("set");
    for (std::size_t i = 0; i < sets.size(); ++i)
        study.sets.push_back({sets[i], document.place(fmt::format("set[{}]", i))});
    study.seeds = read_seeds(document, "seeds");
    study.one_stiffness = document.text("stiffness").value_or("shared") == "shared";
    read_variants(document, study);
    for (std::size_t i = 0; i < document.size("vary"); ++i)
        read_variation(document, fmt::format("vary[{}]", i), study);
    if (study.variations.empty() && study.seeds.empty())
        throw UserError("{}:1:1: varies nothing; write [[vary]] with a key and its values, or seeds = 3",
                        study.file.string());
    const FilmedScene scene = longest_scene(study);
    for (std::size_t i = 0; i < document.size("measure"); ++i)
        read_measure(document, scene, fmt::format("measure[{}]", i), study);
    if (study.search) complete_search(study);
    for (std::size_t i = 0; i < document.size("chart"); ++i)
        read_chart(document, fmt::format("chart[{}]", i), study);
    if (document.size("chart") == 0) add_usual_charts(study);
    document.check_all_read();
    return study;
}

}  // namespace grainreel
