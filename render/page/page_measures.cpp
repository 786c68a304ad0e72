#include "render/page/page_measures.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/measure/columns.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_charts = 4;
// What a bed is looked at for: how two species part, how loose it is, how high it lies, how hot it is.
constexpr const char* usual[] = {"height_difference", "unlike_neighbours", "centre_z_m", "contact_number",
                                 "kinetic_J"};

std::vector<PageColumn> columns_of(const FilmedScene& scene, const MeasureTable& table) {
    const std::vector<MeasureColumn> known = measure_columns(scene);
    std::vector<PageColumn> columns;
    for (const std::string& name : table.columns()) {
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const MeasureColumn& column) { return column.name == name; });
        PageColumn column{name, name, ""};
        if (found != known.end()) {
            column.label = found->label;
            const std::string_view unit = text_of(found->dimension).unit;
            if (unit != "1") column.unit = unit;
        }
        columns.push_back(std::move(column));
    }
    return columns;
}

bool changes(const MeasureTable& table, std::size_t column) {
    std::vector<double> values = table.values(column, 0, table.rows());
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.size() > 1 &&
           *std::min_element(values.begin(), values.end()) != *std::max_element(values.begin(), values.end());
}

}  // namespace

std::vector<std::size_t> spread_rows(std::size_t rows, std::size_t most) {
    std::vector<std::size_t> chosen;
    const std::size_t count = std::min(rows, most);
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(count > 1 ? i * (rows - 1) / (count - 1) : 0);
    return chosen;
}

PageMeasures page_measures(const FilmedScene& scene, const MeasureTable& table) {
    PageMeasures page;
    page.columns = columns_of(scene, table);
    const auto index_of = [&](const std::string& name) {
        const auto found = std::find(table.columns().begin(), table.columns().end(), name);
        return static_cast<std::size_t>(found - table.columns().begin());
    };
    page.time = index_of("time_s");
    if (page.time == page.columns.size()) return page;
    std::vector<std::string> wanted;
    for (const FilmPlot& plot : scene.film.shows.plots) wanted.push_back(plot.column);
    wanted.insert(wanted.end(), std::begin(usual), std::end(usual));
    for (const std::string& name : wanted) {
        const std::size_t column = index_of(name);
        const bool has_it = std::find(page.charted.begin(), page.charted.end(), column) != page.charted.end();
        if (column == page.columns.size() || has_it || !changes(table, column)) continue;
        if (page.charted.size() < most_charts) page.charted.push_back(column);
    }
    page.rows = spread_rows(table.rows(), kMostRowsAtOnce);
    return page;
}

}  // namespace grainreel
