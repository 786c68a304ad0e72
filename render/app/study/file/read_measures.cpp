// Reads what a study measures: [[measure]].
#include <optional>

#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/chapters/words.hpp"
#include "render/app/study/file/read_parts.hpp"
#include "render/scene/keys/named_grains.hpp"
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

// The label on paper: "kinetic energy, slope (J/s)".
std::string printed_label(const MeasureColumn& column, const std::string& how, Reduction::Kind kind) {
    const std::string of_column = text_of(column.dimension).unit;
    const bool is_time = kind == Reduction::Kind::crossing || kind == Reduction::Kind::first_passage;
    std::string unit = of_column == "1" ? "" : of_column;
    if (is_time) unit = "s";
    if (kind == Reduction::Kind::slope) unit = of_column + "/s";
    const std::string name = fmt::format("{}, {}", column.label, how);
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
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
    const std::optional<std::string> label = document.text(table + ".label");
    measure.label = label.value_or(fmt::format("{} ({})", column->label, how));
    for (const StudyMeasure& other : study.measures)
        if (other.name == measure.name)
            document.fail(document.has(table + ".name") ? table + ".name" : table + ".column",
                          fmt::format("gives a second measure the name \"{}\"; give one another 'name'",
                                      excerpt(measure.name)));
    read_window(document, scene, table, measure.reduction);
    read_threshold(document, table, *column, measure.reduction);
    if (!label) measure.printed = printed_label(*column, how, measure.reduction.kind);
    study.measures.push_back(std::move(measure));
}

}  // namespace grainreel
