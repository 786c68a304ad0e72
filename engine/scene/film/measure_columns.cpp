#include "engine/scene/film/measure_columns.hpp"

namespace grainreel {
namespace {

// A name as a part of a column's name: quotes and separators of CSV would break the row.
std::string plain(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

}  // namespace

std::vector<MeasureColumn> measure_columns(const std::vector<std::string>& species) {
    std::vector<MeasureColumn> columns{{"step", "step"},
                                       {"time_s", "time", Dimension::time},
                                       {"phase_turns", "phase (turns)"},
                                       {"cycles", "periods"},
                                       {"kinetic_J", "kinetic energy", Dimension::energy},
                                       {"rotational_J", "energy of rotation", Dimension::energy},
                                       {"gravitational_J", "potential energy", Dimension::energy},
                                       {"elastic_J", "elastic energy", Dimension::energy},
                                       {"wall_work_J", "work of the walls", Dimension::energy},
                                       {"lost_J", "energy lost", Dimension::energy},
                                       {"centre_x_m", "centre of mass, x", Dimension::length},
                                       {"centre_y_m", "centre of mass, y", Dimension::length},
                                       {"centre_z_m", "centre of mass, z", Dimension::length}};
    for (const std::string& name : species) {
        for (const char* axis : {"x", "y", "z"})
            columns.push_back({plain(name) + "_centre_" + axis + "_m", "centre of " + name + ", " + axis,
                               Dimension::length});
        columns.push_back({plain(name) + "_height_m", "mean height of " + name, Dimension::length});
    }
    columns.push_back({"height_difference", "height of big − small"});
    columns.push_back({"big_above_small", "P(big above small)"});
    columns.push_back({"big_in_top_quarter", "big grains in top quarter"});
    columns.push_back({"unlike_neighbours", "unlike pairs / chance"});
    columns.push_back({"lacey", "Lacey mixing index"});
    columns.push_back({"contact_number", "contacts per grain"});
    columns.push_back({"largest_overlap", "largest overlap / radius"});
    columns.push_back({"floor_position_m", "floor position", Dimension::length});
    columns.push_back({"bed_periods", "periods until the bed repeats itself"});
    return columns;
}

}  // namespace grainreel
