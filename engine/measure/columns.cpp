#include "engine/measure/columns.hpp"

#include <fmt/format.h>

#include "engine/measure/observer_list.hpp"

namespace grainreel {
namespace {

template <class T>
ObserverColumns columns_of() {
    ObserverColumns known{nullptr, &T::columns};
    if constexpr (requires { T::instrument; }) known.instrument = T::instrument;
    return known;
}

template <class... Each>
std::vector<ObserverColumns> columns_of_all(ObserverList<Each...>) {
    return {columns_of<Each>()...};
}

std::string names_of(const std::vector<MeasureColumn>& columns) {
    const std::string first = fmt::format("`{}`", columns.front().name);
    if (columns.size() == 1) return first;
    return fmt::format("{}{}`{}`", first, columns.size() > 2 ? " to " : ", ", columns.back().name);
}

// The scene whose columns the documentation lists.
Scene scene_of_names() {
    Scene scene;
    scene.species.resize(1);
    scene.species[0].name = "NAME";
    scene.container.shape = Container::Shape::none;
    scene.walls.resize(1);
    scene.walls[0].name = "FACE";
    scene.meshes.resize(1);
    scene.meshes[0].name = "MESH";
    scene.meshes[0].turn.emplace();
    return scene;
}

std::string instrument_of(const ObserverColumns& entry) {
    return entry.instrument == nullptr ? "" : fmt::format(" (instrument `{}`)", entry.instrument);
}

}  // namespace

const std::vector<ObserverColumns>& observer_columns() {
    static const std::vector<ObserverColumns> all = columns_of_all(RowObservers());
    return all;
}

std::vector<MeasureColumn> measure_columns(const Scene& scene) {
    std::vector<MeasureColumn> columns;
    for (const ObserverColumns& entry : observer_columns())
        for (ColumnGroup& group : entry.groups(scene))
            for (MeasureColumn& column : group.columns) {
                if (entry.instrument != nullptr) column.instrument = entry.instrument;
                columns.push_back(std::move(column));
            }
    return columns;
}

Measurable measurable_in(const Scene& scene) {
    Measurable all{measure_columns(scene), {}};
    for (const ObserverColumns& entry : observer_columns())
        if (entry.instrument != nullptr) all.instruments.push_back(entry.instrument);
    return all;
}

std::string column_table_markdown() {
    std::string text = "| column | unit | what it is |\n|---|---|---|\n";
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(scene_of_names()))
            text += fmt::format("| {} | {} | {}{} |\n", names_of(group.columns), group.unit, group.about,
                                instrument_of(entry));
    return text;
}

}  // namespace grainreel
