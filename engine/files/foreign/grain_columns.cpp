#include "engine/files/foreign/grain_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
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
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* word : {"force", "contact", "overlap"})
        if (name.find(word) != std::string::npos) return true;
    std::erase(name, '_');
    return name == "fx" || name == "fn" || name == "fnx";
}

// Throws UserError where a table without places or radii is one of contacts.
void refuse_contacts(const RawTable& table, const std::string& file) {
    const auto& columns = table.columns;
    if (std::none_of(columns.begin(), columns.end(),
                     [](const auto& one) { return is_of_contacts(one.name); }))
        return;
    for (const RawColumn& one : columns)
        for (const RawColumn& other : columns)
            if (name_partners(one.name, other.name))
                throw UserError(fmt::format(
                    "{}: holds contacts, of {} and {}, and no grains; give the file of the grains, and name "
                    "this one by --contacts",
                    file, excerpt(one.name), excerpt(other.name)));
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
    for (const auto& column :
         {place_[0], place_[1], place_[2], radius_, velocity_[0], velocity_[1], velocity_[2]})
        if (column && !table.columns[*column].words.empty())
            throw UserError(
                fmt::format("{}: column {} holds words such as \"{}\", where numbers are needed; name "
                            "another column by --columns",
                            file_, table.columns[*column].name, table.columns[*column].words.front()));
    if (!units_.real)
        guesses_.push_back(fmt::format("{}: has units lj; one unit of length is drawn as 1 m", file_));
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
        }
    }
    flat_ = place_[0] && place_[1] && !place_[2];
    if (!place_[0] || !place_[1]) refuse_contacts(table, file_);
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
    if (!radius_) refuse_contacts(table, file_);
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
    return place * place_unit_;
}

double GrainMeaning::radius_of(const RawFrame& raw, std::size_t row, const std::string& place) const {
    if (radius_) {
        const double number = value(raw.grains, radius_, row) * radius_unit_ * (is_diameter_ ? 0.5 : 1);
        if (number > 0 && std::isfinite(number)) return number;
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

namespace {

std::vector<std::size_t> by_rising(const std::vector<std::int32_t>& ids) {
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!std::is_sorted(ids.begin(), ids.end()))
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    return order;
}

}  // namespace

State GrainMeaning::frame(const RawFrame& raw, const TypeList& types, const std::string& place) const {
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
        const Vec3 where = place_of(raw, row);
        if (!where.allFinite())
            throw UserError(fmt::format("{}: grain {} has no finite place", place, ids[row]));
        frame.id.push_back(ids[row]);
        frame.species.push_back(static_cast<std::int32_t>(*species));
        frame.radius.push_back(radius_of(raw, row, place));
        frame.position.push_back(where);
        Vec3 velocity(0, 0, 0), spin(0, 0, 0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            if (velocity_[axis]) velocity[a] = value(table, velocity_[axis], row) * velocity_unit_[axis];
            if (spin_[axis]) spin[a] = value(table, spin_[axis], row) / units_.time;
        }
        frame.velocity.push_back(velocity.allFinite() ? velocity : Vec3(0, 0, 0));
        frame.spin.push_back(spin.allFinite() ? spin : Vec3(0, 0, 0));
        if (has_orientations()) {
            Quaternion turned(value(table, quaternion_[0], row), value(table, quaternion_[1], row),
                              value(table, quaternion_[2], row), value(table, quaternion_[3], row));
            const double size = turned.norm();
            frame.orientation.push_back(size > 0 && std::isfinite(size) ? turned.normalized()
                                                                        : Quaternion::Identity());
        }
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
        const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
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
                                            const UnitSystem& units, const std::string& file) {
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
        if (!(std::abs(a) <= kMostId && std::abs(b) <= kMostId)) continue;
        touch.first = static_cast<std::int32_t>(a);
        touch.second = static_cast<std::int32_t>(b);
        if (touch.first < 0) std::swap(touch.first, touch.second);
        if (touch.first < 0) continue;  // a contact of two walls
        if (normal)
            touch.force = std::abs(at(*normal, row)) * units.force();
        else if (fx && fy && fz)
            touch.force = Vec3(at(*fx, row), at(*fy, row), at(*fz, row)).norm() * units.force();
        if (std::isfinite(touch.force)) touches.push_back(touch);
    }
    return touches;
}

}  // namespace grainreel
