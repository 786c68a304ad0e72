#include "engine/measure/columns.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/measure/observer_list.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

template <class T>
ObserverColumns columns_of() {
    ObserverColumns known{nullptr, &T::columns};
    if constexpr (requires { T::instrument; }) known.instrument = T::instrument;
    if constexpr (requires { &T::why_empty; }) known.why_empty = &T::why_empty;
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

// A scene with one part of each kind that has columns of its own. The names of the parts stand for any name
// in the documentation.
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

std::string why_column_is_empty(const Scene& scene, const std::string& column) {
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(scene))
            for (const MeasureColumn& one : group.columns)
                if (one.name == column && entry.why_empty != nullptr) return entry.why_empty(scene, column);
    return "";
}

std::string column_table_markdown() {
    std::string text = "| column | unit | what it is |\n|---|---|---|\n";
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(scene_of_names()))
            text += fmt::format("| {} | {} | {}{} |\n", names_of(group.columns), group.unit, group.about,
                                instrument_of(entry));
    return text;
}

namespace {

bool is_of_a_species(const Scene& scene, const std::string& column, const std::string& what) {
    return std::any_of(scene.species.begin(), scene.species.end(),
                       [&](const Species& species) { return column == column_part(species.name) + what; });
}

// J: the bed's kinetic energy at the drive's speed, or, at rest, what its weight does on the way down.
double usual_energy(const Scene& scene) {
    if (scene.drive.present) return 0.5 * total_mass(scene) * math::square(scene.drive.top_speed());
    return total_mass(scene) * scene.gravity.norm() * scene.container.height;
}

// The size that values of this dimension usually have in this scene; 0 where nothing sets it.
double usual_size(const Scene& scene, Dimension dimension) {
    const double weight = total_mass(scene) * scene.gravity.norm();
    switch (dimension) {
        case Dimension::mass:
            return total_mass(scene);
        case Dimension::mass_flow:
            return scene.run.duration > 0 ? total_mass(scene) / scene.run.duration : 0;
        case Dimension::energy:
            return usual_energy(scene);
        case Dimension::force:
            return weight;
        case Dimension::moment:
            return weight * scene.container.height;
        case Dimension::time:
            return scene.run.duration;
        case Dimension::frequency:
            return scene.drive.present ? scene.drive.highest_frequency() : 0;
        default:
            return 0;
    }
}

double expected_of(const Scene& scene, const std::string& column) {
    if (column == "bed_top_m" || column.starts_with("centre_") || is_of_a_species(scene, column, "_height_m"))
        return scene.container.height;
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(scene))
            for (const MeasureColumn& one : group.columns)
                if (one.name == column) return usual_size(scene, one.dimension);
    return 0;
}

}  // namespace

const std::vector<std::string>& columns_from_zero() {
    static const std::vector<std::string> names{"kinetic_J",           "rotational_J",
                                                "elastic_J",           "lost_J",
                                                "latching_J",          "friction_J",
                                                "damping_J",           "contact_number",
                                                "largest_overlap",     "bed_top_m",
                                                "bed_solid_fraction",  "bed_periods",
                                                "period_difference_m", "flight_periods",
                                                "intruder_level",      "rise_time_s",
                                                "fabric_anisotropy",   "fabric_vertical",
                                                "unlike_neighbours",   "intensity",
                                                "big_above_small",     "big_at_walls",
                                                "big_in_top_quarter",  "big_in_bottom_quarter",
                                                "surface_wave",        "surface_wavelength_m",
                                                "surface_rms_m",       "surface_half",
                                                "surface_quarter",     "outflow_kg",
                                                "outflow_rate",        "emptied_s",
                                                "drive_g_level",       "drive_frequency_Hz"};
    return names;
}

ColumnAxis axis_of_column(const Scene& scene, const std::string& column) {
    const std::vector<std::string>& names = columns_from_zero();
    ColumnAxis axis;
    axis.from_zero = contains(names, column) || is_of_a_species(scene, column, "_outflow") ||
                     is_of_a_species(scene, column, "_height_m");
    axis.expected = expected_of(scene, column);
    return axis;
}

}  // namespace grainreel
