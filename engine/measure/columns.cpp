#include "engine/measure/columns.hpp"

#include <fmt/format.h>

#include "engine/measure/observer_list.hpp"

namespace grainreel {
namespace {

template <class... Each>
std::vector<ObserverEntry> entries_of(ObserverList<Each...>) {
    return {entry_of<Each>()...};
}

std::string names_of(const std::vector<MeasureColumn>& columns) {
    const std::string first = fmt::format("`{}`", columns.front().name);
    if (columns.size() == 1) return first;
    return fmt::format("{}{}`{}`", first, columns.size() > 2 ? " to " : ", ", columns.back().name);
}

// Of the documentation.
Scene scene_of_names() {
    Scene scene;
    scene.species.resize(1);
    scene.species[0].name = "NAME";
    scene.container.shape = Container::Shape::none;
    scene.walls.resize(1);
    scene.walls[0].name = "FACE";
    return scene;
}

std::string instrument_of(const ObserverEntry& entry) {
    return entry.instrument == nullptr ? "" : fmt::format(" (instrument `{}`)", entry.instrument);
}

}  // namespace

const std::vector<ObserverEntry>& all_observers() {
    static const std::vector<ObserverEntry> all = entries_of(RowObservers());
    return all;
}

std::vector<MeasureColumn> measure_columns(const Scene& scene) {
    std::vector<MeasureColumn> columns;
    for (const ObserverEntry& entry : all_observers())
        for (ColumnGroup& group : entry.columns(scene))
            for (MeasureColumn& column : group.columns) {
                if (entry.instrument != nullptr) column.instrument = entry.instrument;
                columns.push_back(std::move(column));
            }
    return columns;
}

Measurable measurable_in(const Scene& scene) {
    Measurable all{measure_columns(scene), {}};
    for (const ObserverEntry& entry : all_observers())
        if (entry.instrument != nullptr) all.instruments.push_back(entry.instrument);
    return all;
}

std::string column_table_markdown() {
    std::string text = "| column | unit | what it is |\n|---|---|---|\n";
    for (const ObserverEntry& entry : all_observers())
        for (const ColumnGroup& group : entry.columns(scene_of_names()))
            text += fmt::format("| {} | {} | {}{} |\n", names_of(group.columns), group.unit, group.about,
                                instrument_of(entry));
    return text;
}

}  // namespace grainreel
