#include "engine/files/foreign/grain_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/names.hpp"

namespace grainreel {

namespace {

constexpr const char* kAxes = "xyz";

UnitSystem units_for(const RawFacts& facts, const ReadingOptions& options, const std::string& file) {
    const std::string& name = options.units.empty() ? facts.units : options.units;
    UnitSystem system;
    system.name = "si";
    if (!name.empty()) {
        const std::optional<UnitSystem> known = unit_system(name);
        if (!known && !options.units.empty())
            throw UserError("--units {}: no such units; there are {}", name, fmt::join(unit_names(), ", "));
        if (!known)
            throw UserError("{}: has units '{}', which are not known; name others by --units", file, name);
        system = *known;
    }
    if (options.units.empty() && facts.length_unit) system.length = *facts.length_unit;
    if (options.units.empty() && facts.time_unit) system.time = *facts.time_unit;
    return system;
}

// Throws UserError where a table without places or radii is one of contacts.
void refuse_contacts(const RawTable& table, const std::string& file) {
    const std::optional<Partners> partners = partners_in(table);
    if (!partners) return;
    throw UserError(
        "{}: holds contacts, of {} and {}, and no grains; give the file of the grains, and name "
        "this one by --contacts",
        file, excerpt(table.columns[partners->first].name), excerpt(table.columns[partners->second].name));
}

}  // namespace

void TypeList::add(const std::string& word) {
    if (place(word)) return;
    const auto before = [](const std::string& a, const std::string& b) {
        const std::optional<double> one = number_in(a), other = number_in(b);
        if (one && other) return *one < *other;
        if (one.has_value() != other.has_value()) return one.has_value();
        return a < b;
    };
    words_.insert(std::upper_bound(words_.begin(), words_.end(), word, before), word);
}

std::optional<std::size_t> TypeList::place(const std::string& word) const {
    return place_in(words_, word);
}

std::string type_word(const RawColumn& column, double value) {
    if (!column.words.empty()) {
        const double last = static_cast<double>(column.words.size());
        return value >= 0 && value < last ? column.words[static_cast<std::size_t>(value)] : std::string("?");
    }
    return fmt::format("{:g}", value);
}

GrainMeaning::GrainMeaning(const RawFacts& facts, const RawFrame& frame, const ReadingOptions& options,
                           std::string file)
    : file_(std::move(file)), options_(options), facts_(facts), units_(units_for(facts, options, file_)) {
    const RawTable& table = frame.grains;
    for (const RawColumn& column : table.columns) names_.push_back(column.name);
    const auto find = [&](const std::string& meaning) { return column_for(meaning, table, options_, file_); };
    id_ = find("id");
    type_ = find("type");
    find_places(table);
    if (flat_) check_flat(frame);
    quaternion_ = {find("qw"), find("qx"), find("qy"), find("qz")};
    shapes_ = ShapeColumns(table, options_, file_);
    has_shapes_ =
        !shapes_.telling().empty() && shapes_.has_extents() && has_orientations() && !is_radius_said();
    find_radius(table);
    density_ = find("density");
    mass_ = find("mass");
    velocity_ = {find("vx"), find("vy"), find("vz")};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        velocity_unit_[axis] = units_.velocity();
        if (const auto unit = unit_in_name(velocity_[axis], Dimension::speed)) velocity_unit_[axis] = *unit;
    }
    spin_ = {find("wx"), find("wy"), find("wz")};
    refuse_words(table);
    tell_of_unwrapped(frame);
    tell_of_shapes();
    if (!units_.real)
        guesses_.push_back(fmt::format("{}: has units lj; one unit of length is drawn as 1 m", file_));
}

void GrainMeaning::refuse_words(const RawTable& table) const {
    std::vector<Column> columns{radius_, density_, mass_};
    for (const auto& three : {place_, velocity_, spin_})
        columns.insert(columns.end(), three.begin(), three.end());
    columns.insert(columns.end(), quaternion_.begin(), quaternion_.end());
    for (const std::size_t column : shapes_.all()) columns.emplace_back(column);
    for (const Column& column : columns)
        if (column && !table.columns[*column].words.empty())
            throw UserError(
                "{}: column {} holds words such as \"{}\", where numbers are needed; name "
                "another column by --columns",
                file_, table.columns[*column].name, table.columns[*column].words.front());
    if (!id_) return;
    // Names of grains may be words. A word among numbers is damage, and would give all grains other ids.
    const std::vector<std::string>& words = table.columns[*id_].words;
    const auto is_number = [](const std::string& word) { return number_in(word).has_value(); };
    const auto word = std::find_if_not(words.begin(), words.end(), is_number);
    if (word != words.end() && std::any_of(words.begin(), words.end(), is_number))
        throw UserError(
            "{}: column {} holds the word \"{}\" among numbers; name another column "
            "of ids by --columns id=NAME, or write its number",
            file_, table.columns[*id_].name, excerpt(*word));
}

// Places of LAMMPS' columns xu, yu and zu are moved back into the periodic box, where x, y and z would have
// them.
void GrainMeaning::tell_of_unwrapped(const RawFrame& frame) {
    std::string names;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        unwrapped_[axis] = unwrapped_[axis] && frame.box && frame.box->periodic[axis];
        if (!unwrapped_[axis]) continue;
        names += fmt::format("{}{}={}", names.empty() ? "" : ",", kAxes[axis], names_[*place_[axis]]);
    }
    if (names.empty()) return;
    guesses_.push_back(
        fmt::format("{}: its places go on outside of its periodic box; they are shown inside of it, and "
                    "--columns {} leaves them where they are",
                    file_, names));
}

void GrainMeaning::tell_of_shapes() {
    if (shapes_.telling().empty()) return;
    const std::string beginning =
        fmt::format("{}: has grains that are no spheres ({})", file_, fmt::join(shapes_.telling(), ", "));
    if (has_shapes_) {
        guesses_.push_back(fmt::format("{}; they are drawn as {}, and measured as spheres of the same volume",
                                       beginning, shapes_.any_blockiness() ? "superquadrics" : "ellipsoids"));
        return;
    }
    const std::string size = radius_ ? fmt::format("the {} in its column {}",
                                                   is_diameter_ ? "diameter" : "radius", names_[*radius_])
                                     : std::string("the radius of --radius");
    const std::string why = is_radius_said()        ? ""
                            : shapes_.has_extents() ? "; it does not say how they are turned"
                                                    : "; it does not say how long they are along their axes";
    guesses_.push_back(
        fmt::format("{}; they are drawn and measured as spheres with {}{}", beginning, size, why));
}

std::optional<double> GrainMeaning::unit_in_name(Column column, Dimension dimension) {
    if (!column || !options_.units.empty()) return std::nullopt;
    const std::string& name = names_[*column];
    const std::string unit = unit_of_name(name);
    const std::optional<double> size = unit_size_in(unit, dimension);
    if (!size && parse_unit(unit))
        guesses_.push_back(fmt::format(
            "{}: the unit in the name of the column \"{}\" does not measure {}; it is passed over", file_,
            excerpt(name), text_of(dimension).noun));
    return size;
}

void GrainMeaning::find_places(const RawTable& table) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string letter(1, kAxes[axis]);
        place_[axis] = column_for(letter, table, options_, file_);
        for (const auto& [suffix, scaled] : {std::pair("u", false), {"s", true}, {"su", true}}) {
            if (place_[axis]) break;
            place_[axis] = column_for(letter + suffix, table, options_, file_);
            scaled_[axis] = scaled;
            unwrapped_[axis] = place_[axis] && std::string_view(suffix).ends_with('u');
        }
    }
    flat_ = place_[0] && place_[1] && !place_[2];
    if (!place_[0] || !place_[1]) refuse_contacts(table, file_);
    if (!place_[0] || !place_[1])
        throw UserError("{}: has no columns of places; name them by --columns x=...,y=...,z=...; it has {}",
                        file_, names_in(table));
    place_unit_ = unit_in_name(place_[0], Dimension::length).value_or(units_.length);
}

// For a file without a column z: throws UserError unless the grains are discs in a plane. They are discs if
// the file says so. They are also discs if the box is periodic along z and its thickness is at most 1 (in
// units of the file) or at most a tenth of its width.
void GrainMeaning::check_flat(const RawFrame& frame) const {
    if (facts_.dimensions == 2) return;
    const bool thin = frame.box && frame.box->periodic[2] &&
                      frame.box->edges[2].norm() <= 1.0001 * std::max(1.0, 0.1 * frame.box->edges[0].norm());
    if (!thin)
        throw UserError(
            "{}: has no column z, and its box is not that of discs in a plane; name the column "
            "by --columns z=...; "
            "it has {}",
            file_, names_in(frame.grains));
}

bool GrainMeaning::is_radius_said() const {
    return options_.radius || !options_.radius_of_type.empty() || options_.columns.count("radius") > 0 ||
           options_.columns.count("diameter") > 0;
}

void GrainMeaning::find_radius(const RawTable& table) {
    if (options_.radius || !options_.radius_of_type.empty()) return;
    const bool named = options_.columns.count("diameter") > 0 && options_.columns.count("radius") == 0;
    if (!named) radius_ = column_for("radius", table, options_, file_);
    if (!radius_) {
        radius_ = column_for("diameter", table, options_, file_);
        is_diameter_ = radius_.has_value();
    }
    if (!radius_ && has_shapes_) return;
    if (!radius_) refuse_contacts(table, file_);
    if (!radius_)
        throw UserError(
            "{}: says no radius of its grains; give one by --radius 2mm (or 1=2mm,2=5mm by "
            "type), or name the column by "
            "--columns radius=NAME; it has {}",
            file_, names_in(table));
    radius_unit_ = unit_in_name(radius_, Dimension::length).value_or(place_unit_);
}

// The columns are known by their places, so these must not change from frame to frame.
void GrainMeaning::check_columns(const RawTable& table, const std::string& place) const {
    if (table.rows == 0) return;
    for (std::size_t k = 0; k < names_.size(); ++k)
        if (k >= table.columns.size() || table.columns[k].name != names_[k])
            throw UserError("{}: has other columns than the first frame; {} is not at its place", place,
                            names_[k]);
}

void GrainMeaning::add_types(const RawFrame& raw, TypeList& types) const {
    check_columns(raw.grains, file_);
    if (!type_) {
        types.add("1");
        return;
    }
    // Making the word of a type takes long, so that it is made once.
    std::vector<double> known;
    constexpr std::size_t most = 1000;
    for (std::size_t row = 0; row < raw.grains.rows; ++row) {
        const double number = value(raw.grains, type_, row);
        if (contains(known, number)) continue;
        known.push_back(number);
        types.add(type_of(raw, row));
        if (types.words().size() > most)
            throw UserError(
                "{}: column {} has more than {} values, so it holds no types; name the column by "
                "--columns type=NAME",
                file_, raw.grains.columns[*type_].name, most);
    }
}

double GrainMeaning::least_id(const RawFrame& raw) const {
    if (!id_ || *id_ >= raw.grains.columns.size()) return facts_.first_row_id;
    const std::vector<double>& ids = raw.grains.columns[*id_].values;
    return *std::min_element(ids.begin(), ids.end());
}

std::optional<WorldCell> GrainMeaning::cell(const RawFrame& raw) const {
    if (!raw.box) return std::nullopt;
    WorldCell cell = *raw.box;
    cell.origin *= units_.length;
    for (Vec3& edge : cell.edges) edge *= units_.length;
    return cell;
}

}  // namespace grainreel
