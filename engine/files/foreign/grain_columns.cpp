#include "engine/files/foreign/grain_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/foreign/names.hpp"

namespace grainreel {

namespace {

constexpr const char* kAxes = "xyz";
constexpr double kMostId = 2147483646;  // ids have 32 bits in a State

UnitSystem units_for(const RawFacts& facts, const ReadingOptions& options, const std::string& file) {
    const std::string& name = options.units.empty() ? facts.units : options.units;
    UnitSystem system;
    system.name = "si";
    if (!name.empty()) {
        const std::optional<UnitSystem> known = unit_system(name);
        if (!known && !options.units.empty())
            throw UserError(
                fmt::format("--units {}: no such units; there are {}", name, fmt::join(unit_names(), ", ")));
        if (!known)
            throw UserError(
                fmt::format("{}: has units '{}', which are not known; name others by --units", file, name));
        system = *known;
    }
    if (options.units.empty() && facts.length_unit) system.length = *facts.length_unit;
    if (options.units.empty() && facts.time_unit) system.time = *facts.time_unit;
    return system;
}

}  // namespace

void Gaps::add(const Gaps& other) {
    velocities += other.velocities;
    spins += other.spins;
    orientations += other.orientations;
    masses += other.masses;
    contacts += other.contacts;
    if (first < 0) first = other.first;
}

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
    const auto found = std::find(words_.begin(), words_.end(), word);
    if (found == words_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - words_.begin());
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
    find_radius(table);
    density_ = find("density");
    mass_ = find("mass");
    velocity_ = {find("vx"), find("vy"), find("vz")};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        velocity_unit_[axis] = units_.velocity();
        if (const auto unit = unit_in_name(velocity_[axis], Dimension::speed)) velocity_unit_[axis] = *unit;
    }
    spin_ = {find("wx"), find("wy"), find("wz")};
    quaternion_ = {find("qw"), find("qx"), find("qy"), find("qz")};
    refuse_words(table);
    tell_of_unwrapped(frame);
    tell_of_shapes(table);
    if (!units_.real)
        guesses_.push_back(fmt::format("{}: has units lj; one unit of length is drawn as 1 m", file_));
}

void GrainMeaning::refuse_words(const RawTable& table) const {
    std::vector<Column> columns{radius_, density_, mass_};
    for (const auto& three : {place_, velocity_, spin_})
        columns.insert(columns.end(), three.begin(), three.end());
    columns.insert(columns.end(), quaternion_.begin(), quaternion_.end());
    for (const Column& column : columns)
        if (column && !table.columns[*column].words.empty())
            throw UserError(
                fmt::format("{}: column {} holds words such as \"{}\", where numbers are needed; name "
                            "another column by --columns",
                            file_, table.columns[*column].name, table.columns[*column].words.front()));
    if (!id_) return;
    // Names of grains may be words. A word among numbers is damage, and would give all grains other ids.
    const std::vector<std::string>& words = table.columns[*id_].words;
    const auto is_number = [](const std::string& word) { return number_in(word).has_value(); };
    const auto word = std::find_if_not(words.begin(), words.end(), is_number);
    if (word != words.end() && std::any_of(words.begin(), words.end(), is_number))
        throw UserError(
            fmt::format("{}: column {} holds the word \"{}\" among numbers; name another column "
                        "of ids by --columns id=NAME, or write its number",
                        file_, table.columns[*id_].name, excerpt(*word)));
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

namespace {

bool same_name(const std::string& name, const char* other) {
    return std::equal(name.begin(), name.end(), other, other + std::string_view(other).size(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

// Names of columns that say how far a grain reaches along its three axes: LAMMPS and LIGGGHTS, OVITO, VTK.
constexpr std::array<std::array<const char*, 3>, 5> kExtents{
    {{"shapex", "shapey", "shapez"},
     {"c_shape[1]", "c_shape[2]", "c_shape[3]"},
     {"asphericalshapex", "asphericalshapey", "asphericalshapez"},
     {"aspherical_shape:0", "aspherical_shape:1", "aspherical_shape:2"},
     {"shape:0", "shape:1", "shape:2"}}};
constexpr std::array<const char*, 2> kBlockiness{"blockiness1", "blockiness2"};

const RawColumn* named(const RawTable& table, const char* name) {
    for (const RawColumn& column : table.columns)
        if (same_name(column.name, name)) return &column;
    return nullptr;
}

}  // namespace

// Ellipsoids and superquadrics: grains whose extents differ, or whose blockiness is not that of an ellipsoid.
void GrainMeaning::tell_of_shapes(const RawTable& table) {
    constexpr double hair = 1e-3;
    std::vector<std::string> names;
    for (const auto& three : kExtents) {
        std::array<const RawColumn*, 3> columns{};
        for (std::size_t k = 0; k < 3; ++k) columns[k] = named(table, three[k]);
        if (!columns[0] || !columns[1] || !columns[2]) continue;
        for (std::size_t row = 0; row < table.rows && names.empty(); ++row) {
            const auto [least, most] =
                std::minmax({columns[0]->values[row], columns[1]->values[row], columns[2]->values[row]});
            if (most - least > hair * most)
                for (const RawColumn* column : columns) names.push_back(column->name);
        }
    }
    for (const char* name : kBlockiness) {
        const RawColumn* column = named(table, name);
        if (column && std::any_of(column->values.begin(), column->values.end(),
                                  [&](double value) { return std::abs(value - 2) > hair; }))
            names.push_back(column->name);
    }
    if (names.empty()) return;
    const std::string size = radius_ ? fmt::format("the {} in its column {}",
                                                   is_diameter_ ? "diameter" : "radius", names_[*radius_])
                                     : std::string("the radius of --radius");
    guesses_.push_back(
        fmt::format("{}: has grains that are no spheres ({}); they are drawn and measured as spheres with {}",
                    file_, fmt::join(names, ", "), size));
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
    const bool user_says =
        options_.columns.count("x") + options_.columns.count("y") + options_.columns.count("z") > 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string letter(1, kAxes[axis]);
        place_[axis] = column_for(letter, table, options_, file_);
        scaled_[axis] = place_[axis] && facts_.scaled_places && !user_says;
        for (const auto& [suffix, scaled] : {std::pair("u", false), {"s", true}, {"su", true}}) {
            if (place_[axis]) break;
            place_[axis] = column_for(letter + suffix, table, options_, file_);
            scaled_[axis] = scaled;
            unwrapped_[axis] = place_[axis] && std::string_view(suffix).ends_with('u');
        }
    }
    flat_ = place_[0] && place_[1] && !place_[2];
    if (!place_[0] || !place_[1])
        throw UserError(
            fmt::format("{}: has no columns of places; name them by --columns x=...,y=...,z=...; it has {}",
                        file_, names_in(table)));
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
            fmt::format("{}: has no column z, and its box is not that of discs in a plane; name the column "
                        "by --columns z=...; "
                        "it has {}",
                        file_, names_in(frame.grains)));
}

void GrainMeaning::find_radius(const RawTable& table) {
    const bool said = options_.radius || !options_.radius_of_type.empty();
    if (said) return;
    const bool named = options_.columns.count("diameter") > 0 && options_.columns.count("radius") == 0;
    if (!named) radius_ = column_for("radius", table, options_, file_);
    if (!radius_) {
        radius_ = column_for("diameter", table, options_, file_);
        is_diameter_ = radius_.has_value();
    }
    if (!radius_)
        throw UserError(
            fmt::format("{}: says no radius of its grains; give one by --radius 2mm (or 1=2mm,2=5mm by "
                        "type), or name the column by "
                        "--columns radius=NAME; it has {}",
                        file_, names_in(table)));
    radius_unit_ = unit_in_name(radius_, Dimension::length).value_or(place_unit_);
}

Vec3 GrainMeaning::place_of(const RawFrame& raw, std::size_t row) const {
    Vec3 place(0, 0, 0), share(0, 0, 0);
    bool any_scaled = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!place_[axis]) continue;
        const double number = value(raw.grains, place_[axis], row);
        (scaled_[axis] ? share : place)[static_cast<Eigen::Index>(axis)] = number;
        any_scaled = any_scaled || scaled_[axis];
    }
    if (any_scaled) {
        if (!raw.box) throw UserError(fmt::format("{}: has places as shares of a box, but no box", file_));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            if (!scaled_[axis]) continue;
            // A fraction is multiplied by the whole edge; a coordinate that is a length stays as it is.
            const Vec3 along = share[a] * raw.box->edges[axis];
            place[a] += raw.box->origin[a];
            for (std::size_t other = 0; other < 3; ++other)
                if (scaled_[other])
                    place[static_cast<Eigen::Index>(other)] += along[static_cast<Eigen::Index>(other)];
        }
    }
    if (raw.box)
        for (std::size_t edge = 3; edge-- > 0;) {
            const auto a = static_cast<Eigen::Index>(edge);
            const double length = raw.box->edges[edge][a];
            if (unwrapped_[edge] && raw.box->periodic[edge] && length > 0)
                place -= std::floor((place[a] - raw.box->origin[a]) / length) * raw.box->edges[edge];
        }
    return place * place_unit_;
}

double GrainMeaning::radius_of(const RawFrame& raw, std::size_t row, const std::string& place) const {
    if (radius_) {
        const double number = value(raw.grains, radius_, row) * radius_unit_ * (is_diameter_ ? 0.5 : 1);
        if (number > 0 && number <= kLargestRadius) return number;
        throw UserError(fmt::format(
            "{}: a grain in row {} has {} {}; give the radius by --radius 2mm, or name another column by "
            "--columns "
            "radius=NAME",
            place, row + 1, is_diameter_ ? "a diameter of" : "a radius of", value(raw.grains, radius_, row)));
    }
    if (!options_.radius_of_type.empty()) {
        const std::string word = type_of(raw, row);
        const auto found = options_.radius_of_type.find(word);
        if (found != options_.radius_of_type.end()) return found->second;
        if (!options_.radius)
            throw UserError(fmt::format(
                "{}: a grain is of type {}, for which --radius says nothing; add {}=2mm", place, word, word));
    }
    return *options_.radius;
}

std::string GrainMeaning::type_of(const RawFrame& raw, std::size_t row) const {
    if (!type_) return "1";
    const RawColumn& column = raw.grains.columns[*type_];
    if (!std::isfinite(column.values[row]))
        throw UserError(
            fmt::format("{}: a grain in row {} has no type: its {} is {}; write it, or name "
                        "another column by --columns type=NAME",
                        file_, row + 1, column.name, column.values[row]));
    return type_word(raw.grains.columns[*type_], value(raw.grains, type_, row));
}

// The columns are known by their places, so these must not change from frame to frame.
void GrainMeaning::check_columns(const RawTable& table, const std::string& place) const {
    if (table.rows == 0) return;
    for (std::size_t k = 0; k < names_.size(); ++k)
        if (k >= table.columns.size() || table.columns[k].name != names_[k])
            throw UserError(fmt::format("{}: has other columns than the first frame; {} is not at its place",
                                        place, names_[k]));
}

void GrainMeaning::add_types(const RawFrame& raw, TypeList& types) const {
    check_columns(raw.grains, file_);
    if (!type_) {
        types.add("1");
        return;
    }
    // Neighbouring rows often have the same type, so the word is made only where the type changes.
    double last = std::numeric_limits<double>::quiet_NaN();
    constexpr std::size_t most = 1000;
    for (std::size_t row = 0; row < raw.grains.rows; ++row) {
        const double number = value(raw.grains, type_, row);
        if (number == last) continue;
        last = number;
        types.add(type_of(raw, row));
        if (types.words().size() > most)
            throw UserError(
                fmt::format("{}: column {} has more than {} values, so it holds no types; name the column by "
                            "--columns type=NAME",
                            file_, raw.grains.columns[*type_].name, most));
    }
}

std::optional<WorldCell> GrainMeaning::cell(const RawFrame& raw) const {
    if (!raw.box) return std::nullopt;
    WorldCell cell = *raw.box;
    cell.origin *= units_.length;
    for (Vec3& edge : cell.edges) edge *= units_.length;
    return cell;
}

namespace {

double volume_of(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

// The number, or NaN where it is none or none that a grain can have.
double or_unknown(double number, double limit) {
    return std::abs(number) <= limit ? number : kUnknown;
}

std::vector<std::size_t> by_rising(const std::vector<std::int32_t>& ids) {
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!std::is_sorted(ids.begin(), ids.end()))
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    return order;
}

}  // namespace

// The mass (kg) of the grain in a row; NaN where the file does not say a mass that a grain can have.
double GrainMeaning::mass_in(const RawTable& table, std::size_t row, double radius) const {
    const double mass = mass_ ? value(table, mass_, row) * units_.mass
                              : value(table, density_, row) * units_.density() * volume_of(radius);
    return mass > 0 && std::isfinite(mass) ? mass : kUnknown;
}

void GrainMeaning::add_grain(const RawFrame& raw, std::size_t row, const std::string& place, State& state,
                             Gaps& gaps) const {
    const RawTable& table = raw.grains;
    const std::int32_t id = state.id.back();
    const Vec3 where = place_of(raw, row);
    if (!where.allFinite()) throw UserError(fmt::format("{}: grain {} has no finite place", place, id));
    if (where.cwiseAbs().maxCoeff() > kFarthestPlace)
        throw UserError(
            fmt::format("{}: grain {} is at ({:.3g}, {:.3g}, {:.3g}) m, where no bed reaches; is "
                        "the file damaged, or are its units others (--units)?",
                        place, id, where.x(), where.y(), where.z()));
    state.radius.push_back(radius_of(raw, row, place));
    state.position.push_back(where);
    Vec3 velocity(0, 0, 0), spin(0, 0, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        if (velocity_[axis])
            velocity[a] = or_unknown(value(table, velocity_[axis], row) * velocity_unit_[axis], kFastest);
        if (spin_[axis]) spin[a] = or_unknown(value(table, spin_[axis], row) / units_.time, kFastestSpin);
    }
    state.velocity.push_back(velocity);
    state.spin.push_back(spin);
    gaps.velocities += velocity.hasNaN();
    gaps.spins += spin.hasNaN();
    if (gaps.first < 0 && (velocity.hasNaN() || spin.hasNaN())) gaps.first = id;
    if (has_masses()) {
        state.mass.push_back(mass_in(table, row, state.radius.back()));
        gaps.masses += std::isnan(state.mass.back());
    }
    if (!has_orientations()) return;
    const Quaternion turned(value(table, quaternion_[0], row), value(table, quaternion_[1], row),
                            value(table, quaternion_[2], row), value(table, quaternion_[3], row));
    const double size = turned.norm();
    const bool known = size > 0 && std::isfinite(size);
    state.orientation.push_back(known ? turned.normalized() : Quaternion::Identity());
    gaps.orientations += !known;
}

State GrainMeaning::frame(const RawFrame& raw, const TypeList& types, const std::string& place,
                          Gaps& gaps) const {
    const RawTable& table = raw.grains;
    check_columns(table, place);
    std::vector<std::int32_t> ids(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row) {
        const double number = id_ ? value(table, id_, row) : static_cast<double>(row) + facts_.first_row_id;
        if (!(number >= 0 && number <= kMostId && number == std::floor(number)))
            throw UserError(fmt::format("{}: row {} has the id {}, which is no whole number from 0 to {:.0f}",
                                        place, row + 1, number, kMostId));
        ids[row] = static_cast<std::int32_t>(number);
    }
    const std::vector<std::size_t> order = by_rising(ids);
    State frame;
    std::optional<std::size_t> species;
    double last_type = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t row = order[i];
        if (i > 0 && ids[order[i - 1]] == ids[row])
            throw UserError(
                fmt::format("{}: grain {} comes twice; a grain has one row in each frame", place, ids[row]));
        // Neighbouring rows often have the same type, so the word is made only where the type changes.
        const double type = type_ ? value(table, type_, row) : 0;
        if (!species || type != last_type) {
            species = types.place(type_of(raw, row));
            last_type = type;
        }
        if (!species)
            throw UserError(
                fmt::format("{}: grain {} is of type {}, which no frame that was looked at first had; name "
                            "all types by --species",
                            place, ids[row], type_of(raw, row)));
        frame.id.push_back(ids[row]);
        frame.species.push_back(static_cast<std::int32_t>(*species));
        add_grain(raw, row, place, frame, gaps);
    }
    return frame;
}

std::vector<double> GrainMeaning::densities(const RawFrame& raw, const TypeList& types) const {
    const std::size_t count = types.words().size();
    std::vector<double> sums(count, 0), grains(count, 0);
    if (options_.density) return std::vector<double>(count, *options_.density);
    if (!density_ && !mass_) return std::vector<double>(count, kUnknown);
    for (std::size_t row = 0; row < raw.grains.rows; ++row) {
        const std::optional<std::size_t> species = types.place(type_of(raw, row));
        if (!species) continue;
        const double radius = radius_of(raw, row, file_);
        const double volume = volume_of(radius);
        const double density = density_ ? value(raw.grains, density_, row) * units_.density()
                                        : value(raw.grains, mass_, row) * units_.mass / volume;
        if (!(density > 0) || !std::isfinite(density)) continue;
        sums[*species] += density;
        ++grains[*species];
    }
    for (std::size_t s = 0; s < count; ++s) sums[s] = grains[s] > 0 ? sums[s] / grains[s] : kUnknown;
    return sums;
}

std::optional<std::vector<Link>> touches_of(const RawFrame& raw, const ReadingOptions& options,
                                            const UnitSystem& units, const std::string& file, Gaps& gaps) {
    const RawTable& table = raw.contacts;
    const auto first = column_for("id1", table, options, file),
               second = column_for("id2", table, options, file);
    if (!first || !second) return std::nullopt;
    const auto normal = column_for("force", table, options, file);
    const auto fx = column_for("fx", table, options, file), fy = column_for("fy", table, options, file),
               fz = column_for("fz", table, options, file);
    const auto at = [&](std::size_t column, std::size_t row) { return table.columns[column].values[row]; };
    std::vector<Link> touches;
    for (std::size_t row = 0; row < table.rows; ++row) {
        Link touch{};
        const double a = at(*first, row), b = at(*second, row);
        if (!(std::abs(a) <= kMostId && std::abs(b) <= kMostId)) {
            ++gaps.contacts;
            continue;
        }
        touch.first = static_cast<std::int32_t>(a);
        touch.second = static_cast<std::int32_t>(b);
        if (touch.first < 0) std::swap(touch.first, touch.second);
        if (touch.first < 0) continue;  // a contact of two walls
        if (normal)
            touch.force = std::abs(at(*normal, row)) * units.force();
        else if (fx && fy && fz)
            touch.force = Vec3(at(*fx, row), at(*fy, row), at(*fz, row)).norm() * units.force();
        if (std::isfinite(touch.force))
            touches.push_back(touch);
        else
            ++gaps.contacts;
    }
    return touches;
}

}  // namespace grainreel
