#include "render/page/page_measures.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/text/units.hpp"
#include "render/page/embed.hpp"
#include "render/scene/axis_titles.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_charts = 4;
// The measures that usually matter: how two species separate (the first two), how high the bed lies, how many
// contacts a grain has, how large the kinetic energy is.
constexpr const char* usual[] = {"height_difference", "unlike_neighbours", "centre_z_m", "contact_number",
                                 "kinetic_J"};

// The units in which values of any size are shown, from the largest; empty for pure numbers.
std::vector<std::pair<std::string, double>> units_of(Dimension dimension) {
    std::vector<std::pair<std::string, double>> units;
    for (double value = 1e9; value > 1e-13; value /= 10) {
        const std::string unit = fitting_unit(value, dimension);
        if (unit.empty() || unit == "1" || (!units.empty() && units.back().first == unit)) continue;
        units.emplace_back(unit, unit_size(unit, dimension));
    }
    return units;
}

// A label that says its unit fixes that of the chart.
void name_by_plot(PageColumn& column, const FilmPlot& plot) {
    const LabelParts label = label_parts(plot.label, plot.dimension);
    column.label = label.words;
    if (!label.unit.empty()) column.units = {{label.unit, unit_size(label.unit, plot.dimension)}};
}

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
            column.units = units_of(found->dimension);
            column.label = phrase(scene.film.wording.language, column.label);
        }
        for (const FilmPlot& plot : scene.film.shows.plots)
            if (plot.column == name) {
                name_by_plot(column, plot);
                column.smooth = plot.period && scene.drive.present;
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
    const bool smooth = std::any_of(page.columns.begin(), page.columns.end(),
                                    [](const PageColumn& column) { return column.smooth; });
    if (const std::size_t cycles = index_of("cycles"); smooth && cycles < page.columns.size())
        page.cycles = cycles;
    page.rows = spread_rows(table.rows(), kMostRowsAtOnce);
    return page;
}

namespace {

namespace fs = std::filesystem;
using Values = std::vector<double>;

constexpr std::size_t most_cells = 4'000'000;         // cells of a record in the file
constexpr std::size_t most_plain_bytes = 20'000'000;  // bytes of the page's fields before they are packed
constexpr double most_level = 254;  // highest level of a value in a byte; 255 means no value

// The name of a species as it stands in the names of its variables in fields.nc (FieldsWriter).
std::string in_variable(const std::string& name) {
    std::string text = name;
    for (char& c : text)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
    return text;
}

class FieldsFile {
  public:
    explicit FieldsFile(const fs::path& path) : file_(NetcdfFile::open(path)) {
        records_ = file_.records_on_disk(file_.length("time"));
        nx_ = file_.has_variable("x") ? file_.length("x") : 1;
        ny_ = file_.length("y");
        nz_ = file_.length("z");
        if (nx_ == 0 || ny_ == 0 || nz_ == 0 || nx_ > most_cells || ny_ > most_cells || nz_ > most_cells ||
            nx_ * ny_ > most_cells || nx_ * ny_ * nz_ > most_cells)
            throw UserError("its grid is too large for a page");
    }

    bool has(const std::string& name) const { return file_.has_variable(name); }
    std::size_t records() const { return records_; }
    std::size_t cells() const { return ny_ * nz_; }

    PageFields::Axis axis(const char* name) const {
        Values middles(file_.length(name));
        file_.get(file_.find_variable(name), {0}, {middles.size()}, middles.data());
        const double cell = middles.size() > 1 ? middles[1] - middles[0] : 1;
        if (!std::isfinite(middles.front()) || !(cell > 0) || !std::isfinite(cell))
            throw UserError("its grid is damaged");
        return {middles.front() - cell / 2, cell, middles.size()};
    }

    PageFields::Record bounds(std::size_t record) const {
        double ends[2];
        file_.get(file_.find_variable("time_bounds"), {record, 0}, {1, 2}, ends);
        return {ends[0], ends[1]};
    }

    // How a grid in three dimensions becomes a plane: by the mean over the depth, weighted by each cell's
    // room, or by the sum.
    enum class Depth { mean, sum };
    Values plane(const std::string& name, std::size_t record, Depth depth = Depth::mean) const {
        const bool sum = depth == Depth::sum;
        const int variable = file_.find_variable(name);
        if (nx_ == 1) return read(variable, record);
        const Values all = read(variable, record), room = read(file_.find_variable("free_volume"), record);
        Values plane(cells());
        for (std::size_t cell = 0; cell < cells(); ++cell) {
            double total = 0, weight = 0;
            for (std::size_t x = 0; x < nx_; ++x) {
                const double value = all[cell * nx_ + x], part = sum ? 1 : room[cell * nx_ + x];
                if (!std::isfinite(value)) continue;
                total += value * part;
                weight += part;
            }
            plane[cell] = sum ? total : weight > 0 ? total / weight : kUnknown;
        }
        return plane;
    }

  private:
    Values read(int variable, std::size_t record) const {
        Values values(nx_ * cells());
        if (file_.has_variable("x"))
            file_.get(variable, {record, 0, 0, 0}, {1, nz_, ny_, nx_}, values.data());
        else
            file_.get(variable, {record, 0, 0}, {1, nz_, ny_}, values.data());
        return values;
    }

    NetcdfFile file_;
    std::size_t records_ = 0, nx_ = 1, ny_ = 0, nz_ = 0;
};

// A quantity, and how its plane is made from a record.
struct Made {
    FieldQuantity about;
    std::function<Values(const FieldsFile&, std::size_t)> of;
};

Values combined(const Values& a, const Values& b, double (*of)(double, double)) {
    Values result(a.size());
    std::transform(a.begin(), a.end(), b.begin(), result.begin(), of);
    return result;
}

// The pressure: a third of the trace of the total stress, kinetic and contact stress together.
Values pressure(const FieldsFile& file, std::size_t record) {
    Values sum(file.cells(), 0.0);
    for (const char* part : {"kinetic_stress_xx", "kinetic_stress_yy", "kinetic_stress_zz",
                             "contact_stress_xx", "contact_stress_yy", "contact_stress_zz"})
        sum = combined(sum, file.plane(part, record), [](double a, double b) { return a + b / 3; });
    return sum;
}

std::vector<Made> quantities_of(const FilmedScene& scene, const FieldsFile& file) {
    std::vector<Made> all;
    const auto add = [&](const char* name, const std::string& label, const char* unit, auto of) {
        all.push_back({{name, label, unit, 0, 0}, of});
    };
    for (const Species& species : scene.species) {
        const std::string variable = "solid_fraction_" + in_variable(species.name);
        if (file.has(variable))
            add(variable.c_str(), "solid fraction of " + species.name, "",
                [variable](const FieldsFile& f, std::size_t r) { return f.plane(variable, r); });
    }
    if (file.has("density"))
        add("density", "density", "kg/m³",
            [](const FieldsFile& f, std::size_t r) { return f.plane("density", r); });
    if (file.has("velocity_y") && file.has("velocity_z")) {
        add("speed", "speed of the flow in the plane", "m/s", [](const FieldsFile& f, std::size_t r) {
            return combined(f.plane("velocity_y", r), f.plane("velocity_z", r),
                            [](double a, double b) { return std::hypot(a, b); });
        });
        add("velocity_y", "velocity across", "m/s",
            [](const FieldsFile& f, std::size_t r) { return f.plane("velocity_y", r); });
        add("velocity_z", "velocity upwards", "m/s",
            [](const FieldsFile& f, std::size_t r) { return f.plane("velocity_z", r); });
    }
    if (file.has("granular_temperature"))
        add("granular_temperature", "granular temperature", "m²/s²",
            [](const FieldsFile& f, std::size_t r) { return f.plane("granular_temperature", r); });
    if (file.has("kinetic_stress_xx") && file.has("contact_stress_zz"))
        add("pressure", "pressure", "Pa", pressure);
    return all;
}

void find_ends(FieldQuantity& quantity, const Values& values, bool first) {
    if (first) quantity.low = quantity.high = kUnknown;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        quantity.low = std::isfinite(quantity.low) ? std::min(quantity.low, value) : value;
        quantity.high = std::isfinite(quantity.high) ? std::max(quantity.high, value) : value;
    }
}

void append(std::vector<std::uint8_t>& bytes, const FieldQuantity& quantity, const Values& values) {
    const double span = quantity.high - quantity.low;
    for (const double value : values) {
        const double share = span > 0 ? (value - quantity.low) / span : 0;
        bytes.push_back(std::isfinite(value) ? static_cast<std::uint8_t>(std::lround(most_level * share))
                                             : 255);
    }
}

// Appends the room of each cell inside the container, relative to the cell with most room. The first record
// has it for all, since the container does not move on the grid.
void append_room(std::vector<std::uint8_t>& bytes, const FieldsFile& file) {
    const Values room = file.plane("free_volume", 0, FieldsFile::Depth::sum);
    const double most = *std::max_element(room.begin(), room.end());
    for (const double volume : room) {
        const double share = most > 0 && std::isfinite(volume) ? volume / most : 0;
        bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))));
    }
}

PageFields read_fields(const FilmedScene& scene, const FieldsFile& file) {
    PageFields fields;
    fields.y = file.axis("y");
    fields.z = file.axis("z");
    fields.all_records = file.records();
    const std::vector<Made> made = quantities_of(scene, file);
    if (fields.all_records == 0 || made.empty()) return fields;
    for (const Made& one : made) fields.quantities.push_back(one.about);
    std::size_t wanted =
        std::clamp<std::size_t>(most_plain_bytes / (made.size() * file.cells()), 1, file.records());
    while (true) {
        const std::vector<std::size_t> chosen = spread_rows(file.records(), wanted);
        fields.records.clear();
        for (const std::size_t record : chosen) fields.records.push_back(file.bounds(record));
        std::vector<std::uint8_t> bytes;
        append_room(bytes, file);
        for (std::size_t q = 0; q < made.size(); ++q)
            for (const std::size_t record : chosen)
                find_ends(fields.quantities[q], made[q].of(file, record), record == chosen.front());
        for (const std::size_t record : chosen)
            for (std::size_t q = 0; q < made.size(); ++q)
                append(bytes, fields.quantities[q], made[q].of(file, record));
        fields.packed = zlib_packed(bytes);
        if (fields.packed.size() <= kMostFieldBytes || wanted == 1) return fields;
        wanted = std::max<std::size_t>(1, 9 * wanted * kMostFieldBytes / fields.packed.size() / 10);
    }
}

}  // namespace

PageFields page_fields(const FilmedScene& scene, const fs::path& folder) {
    if (!scene.output.fields.wanted() || !is_there(folder / "fields.nc")) return {};
    try {
        return read_fields(scene, FieldsFile(folder / "fields.nc"));
    } catch (const UserError& problem) {
        PageFields fields;
        fields.why_not = fmt::format("The run's fields are not on this page: {}.", problem.what());
        return fields;
    }
}

}  // namespace grainreel
