#include "engine/files/foreign/names.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

using Names = std::vector<std::string>;

// The names in lower case. Sources: LAMMPS (dump custom), LIGGGHTS (dump custom/vtk, atom/vtk), YADE
// (VTKRecorder, export.text), MercuryDPM (.data, .vtu), Lethe and MFIX (.vtu), ASE, QUIP and OVITO (extended
// XYZ), GSD, AMBER, DEM-Engine and ParaView (CSV).
const std::vector<std::pair<std::string, Names>>& all() {
    static const std::vector<std::pair<std::string, Names>> list{
        {"id",
         {"id", "log/particles/id", "identifier", "particle identifier", "global_id", "globalid",
          "particle_id", "particleid", "tag", "nr"}},
        {"type",
         {"type", "atom_types", "atom_type", "particle type", "typeid", "species", "element", "info",
          "material", "materialtype", "material_type", "matid", "mat", "typ"}},
        {"x",
         {"x", "position.x", "position:0", "points:0", "coordinates:0", "positions:0", "p_x", "pos:0",
          "x_pos", "position x", "center:0", "px"}},
        {"y",
         {"y", "position.y", "position:1", "points:1", "coordinates:1", "positions:1", "p_y", "pos:1",
          "y_pos", "position y", "center:1", "py"}},
        {"z",
         {"z", "position.z", "position:2", "points:2", "coordinates:2", "positions:2", "p_z", "pos:2",
          "z_pos", "position z", "center:2", "pz"}},
        {"xu", {"xu", "unwrapped_coordinates:0"}},
        {"yu", {"yu", "unwrapped_coordinates:1"}},
        {"zu", {"zu", "unwrapped_coordinates:2"}},
        {"xs", {"xs"}},
        {"ys", {"ys"}},
        {"zs", {"zs"}},
        {"xsu", {"xsu"}},
        {"ysu", {"ysu"}},
        {"zsu", {"zsu"}},
        {"vx",
         {"vx", "v:0", "velo:0", "velocity:0", "velocities:0", "linvelvec:0", "velocity_lin:0", "v_x",
          "velocity.x", "velocity x", "vel:0"}},
        {"vy",
         {"vy", "v:1", "velo:1", "velocity:1", "velocities:1", "linvelvec:1", "velocity_lin:1", "v_y",
          "velocity.y", "velocity y", "vel:1"}},
        {"vz",
         {"vz", "v:2", "velo:2", "velocity:2", "velocities:2", "linvelvec:2", "velocity_lin:2", "v_z",
          "velocity.z", "velocity z", "vel:2"}},
        {"wx",
         {"wx", "omegax", "omega:0", "angvelvec:0", "angularvelocity:0", "angular_velocity:0",
          "angular_velocities:0", "velocity_ang:0", "w_x", "omega_x", "omega.x", "angular velocity.x"}},
        {"wy",
         {"wy", "omegay", "omega:1", "angvelvec:1", "angularvelocity:1", "angular_velocity:1",
          "angular_velocities:1", "velocity_ang:1", "w_y", "omega_y", "omega.y", "angular velocity.y"}},
        {"wz",
         {"wz", "omegaz", "omega:2", "angvelvec:2", "angularvelocity:2", "angular_velocity:2",
          "angular_velocities:2", "velocity_ang:2", "w_z", "omega_z", "omega.z", "angular velocity.z"}},
        {"radius",
         {"radius", "radii", "rad", "r", "particle_radius", "asphericalshapex", "asphericalshape.x"}},
        {"diameter",
         {"diameter", "diameters", "diam", "d", "shapex", "c_diameter", "particle_diameter", "durchmesser"}},
        {"density", {"density", "rho", "densities", "c_density"}},
        {"mass", {"mass", "masses", "m"}},
        {"qw", {"qw", "quatw", "quat1", "orientationw", "orientation:0", "orientation.w"}},
        {"qx", {"qx", "quati", "quat2", "orientationx", "orientation:1", "orientation.x"}},
        {"qy", {"qy", "quatj", "quat3", "orientationy", "orientation:2", "orientation.y"}},
        {"qz", {"qz", "quatk", "quat4", "orientationz", "orientation:3", "orientation.z"}},
        {"shapex", {"shapex"}},
        {"shapey", {"shapey"}},
        {"shapez", {"shapez"}},
        {"semix",
         {"semix", "type_shapes:a", "c_shape[1]", "asphericalshapex", "aspherical_shape:0", "shape:0"}},
        {"semiy",
         {"semiy", "type_shapes:b", "c_shape[2]", "asphericalshapey", "aspherical_shape:1", "shape:1"}},
        {"semiz",
         {"semiz", "type_shapes:c", "c_shape[3]", "asphericalshapez", "aspherical_shape:2", "shape:2"}},
        {"blockiness1", {"blockiness1"}},
        {"blockiness2", {"blockiness2"}},
        {"id1", {"id1", "c_id1", "i", "particle1", "pid1", "geoa"}},
        {"id2", {"id2", "c_id2", "j", "particle2", "pid2", "geob"}},
        {"force", {"fn", "normal_force", "normalforce", "force_normal", "f_n"}},
        {"fx", {"force:0", "fx", "force_x", "c_force:0", "f_x"}},
        {"fy", {"force:1", "fy", "force_y", "c_force:1", "f_y"}},
        {"fz", {"force:2", "fz", "force_z", "c_force:2", "f_z"}},
        {"pressure", {"normal_stress_average", "normal_stress", "pressure"}},
        {"wear", {"wear"}},
        {"step", {"step", "timestep", "iteration"}},
        {"time", {"time", "t"}},
    };
    return list;
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// The name without its unit: "Radius" for "Radius [mm]".
std::string without_unit(const std::string& name) {
    const std::size_t bracket = name.find_first_of("[(");
    if (bracket == std::string::npos || bracket == 0) return name;
    std::string bare = name.substr(0, bracket);
    while (!bare.empty() && bare.back() == ' ') bare.pop_back();
    return bare.empty() ? name : bare;
}

std::optional<std::size_t> place_of(const std::string& wanted, const RawTable& table) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string name = lower(table.columns[i].name);
        if (name == wanted || without_unit(name) == wanted) return i;
    }
    return std::nullopt;
}

// Whether two names differ only in their last letter, as those of the two partners of a contact: id1 and id2,
// geoA and geoB, i and j.
bool name_partners(std::string_view one, std::string_view other) {
    if (one.empty() || one.size() != other.size()) return false;
    const std::size_t last = one.size() - 1;
    if (one.substr(0, last) != other.substr(0, last)) return false;
    constexpr std::string_view pairs[] = {"12", "AB", "ab", "IJ", "ij"};
    return std::any_of(std::begin(pairs), std::end(pairs),
                       [&](std::string_view pair) { return one[last] == pair[0] && other[last] == pair[1]; });
}

bool is_of_contacts(std::string name) {
    name = lower(std::move(name));
    for (const char* word : {"force", "contact", "overlap"})
        if (name.find(word) != std::string::npos) return true;
    std::erase(name, '_');
    return name == "fx" || name == "fn" || name == "fnx";
}

}  // namespace

std::optional<Partners> partners_in(const RawTable& table) {
    const auto& columns = table.columns;
    if (std::none_of(columns.begin(), columns.end(),
                     [](const auto& one) { return is_of_contacts(one.name); }))
        return std::nullopt;
    for (std::size_t first = 0; first < columns.size(); ++first)
        for (std::size_t second = 0; second < columns.size(); ++second)
            if (name_partners(columns[first].name, columns[second].name)) return Partners{first, second};
    return std::nullopt;
}

const std::vector<std::string>& names_of(const std::string& meaning) {
    static const Names none;
    for (const auto& [name, known] : all())
        if (name == meaning) return known;
    return none;
}

std::vector<std::string> all_meanings() {
    std::vector<std::string> names;
    for (const auto& [name, known] : all()) names.push_back(name);
    return names;
}

std::optional<std::size_t> column_for(const std::string& meaning, const RawTable& table,
                                      const ReadingOptions& options, const std::string& file) {
    if (const auto said = options.columns.find(meaning); said != options.columns.end()) {
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (table.columns[i].name == said->second) return i;
        if (const auto place = place_of(lower(said->second), table)) return place;
        throw UserError("--columns {}={}: {} has no such column; it has {}", meaning, said->second, file,
                        names_in(table));
    }
    for (const std::string& name : names_of(meaning))
        if (const auto place = place_of(name, table)) return place;
    return std::nullopt;
}

std::string names_in(const RawTable& table) {
    std::string text;
    for (const RawColumn& column : table.columns) text += (text.empty() ? "" : ", ") + column.name;
    return text.empty() ? "no columns" : text;
}

namespace {

constexpr double dalton = 1.66053906660e-27;  // kg (CODATA 2018)

const std::vector<UnitSystem>& systems() {
    static const std::vector<UnitSystem> all{
        {"si", 1, 1, 1, true},
        {"lj", 1, 1, 1, false},
        {"cgs", 1e-2, 1, 1e-3, true},
        {"mm", 1e-3, 1, 1e-3, true},
        {"micro", 1e-6, 1e-6, 1e-15, true},
        {"nano", 1e-9, 1e-9, 1e-21, true},
        {"real", 1e-10, 1e-15, dalton, true},
        {"metal", 1e-10, 1e-12, dalton, true},
    };
    return all;
}

}  // namespace

std::optional<UnitSystem> unit_system(const std::string& name) {
    for (const UnitSystem& one : systems())
        if (one.name == name) return one;
    return std::nullopt;
}

std::vector<std::string> unit_names() {
    std::vector<std::string> names;
    for (const UnitSystem& one : systems()) names.push_back(one.name);
    return names;
}

std::string unit_of_name(std::string_view name) {
    const std::size_t open = name.find_first_of("[(");
    if (open == std::string_view::npos) return {};
    const std::size_t close = std::min(name.find_first_of("])", open), name.size());
    return std::string(trimmed(name.substr(open + 1, close - open - 1)));
}

}  // namespace grainreel
