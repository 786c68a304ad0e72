#include "engine/measure/column_axis.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

bool is_of_a_species(const Scene& scene, const std::string& column, const std::string& what) {
    return std::any_of(scene.species.begin(), scene.species.end(),
                       [&](const Species& species) { return column == column_part(species.name) + what; });
}

double expected_of(const Scene& scene, const std::string& column) {
    if (column == "outflow_kg") return total_mass(scene);
    if (column == "bed_top_m" || is_of_a_species(scene, column, "_height_m")) return scene.container.height;
    if (column == "kinetic_J" && scene.drive.present)
        return 0.5 * total_mass(scene) * std::pow(scene.drive.top_speed(), 2);
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
    axis.from_zero = std::find(names.begin(), names.end(), column) != names.end() ||
                     is_of_a_species(scene, column, "_outflow") ||
                     is_of_a_species(scene, column, "_height_m");
    axis.expected = expected_of(scene, column);
    return axis;
}

}  // namespace grainreel
