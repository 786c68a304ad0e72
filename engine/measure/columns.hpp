// What all observers of observer_list.hpp give, without a state.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/observer.hpp"

namespace grainreel {

// In the order of their columns.
const std::vector<ObserverEntry>& all_observers();

// The columns of all of them, those of instruments that the scene does not ask for among them.
std::vector<MeasureColumn> measure_columns(const Scene& scene);
// They, and the instruments' names, for the reader of a scene.
Measurable measurable_in(const Scene& scene);

// The table of all columns in Markdown, as in docs/reference/scenes.md.
std::string column_table_markdown();

}  // namespace grainreel
