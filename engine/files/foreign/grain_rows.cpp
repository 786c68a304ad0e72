// Reads the grains and contacts of a frame by the meaning of its columns, which grain_columns.cpp finds.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/foreign/grain_columns.hpp"
#include "engine/files/foreign/names.hpp"

namespace grainreel {

namespace {

constexpr double kMostId = 2147483646;  // ids have 32 bits in a State

}  // namespace

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
        if (!raw.box) throw UserError("{}: has places as shares of a box, but no box", file_);
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
        throw UserError(
            "{}: a grain in row {} has {} {}; give the radius by --radius 2mm, or name another column by "
            "--columns "
            "radius=NAME",
            place, row + 1, is_diameter_ ? "a diameter of" : "a radius of", value(raw.grains, radius_, row));
    }
    if (!options_.radius_of_type.empty()) {
        const std::string word = type_of(raw, row);
        const auto radius = options_.radius_of_type.find(word);
        if (radius != options_.radius_of_type.end()) return radius->second;
        if (!options_.radius)
            throw UserError("{}: a grain is of type {}, for which --radius says nothing; add {}=2mm", place,
                            word, word);
    }
    return *options_.radius;
}

std::string GrainMeaning::type_of(const RawFrame& raw, std::size_t row) const {
    if (!type_) return "1";
    const RawColumn& column = raw.grains.columns[*type_];
    if (!std::isfinite(column.values[row]))
        throw UserError(
            "{}: a grain in row {} has no type: its {} is {}; write it, or name "
            "another column by --columns type=NAME",
            file_, row + 1, column.name, column.values[row]);
    return type_word(raw.grains.columns[*type_], value(raw.grains, type_, row));
}

namespace {

double volume_of(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

// The number, or NaN where it is none or none that a grain can have.
double or_unknown(double number, double limit) {
    return std::abs(number) <= limit ? number : kUnknown;
}

}  // namespace

// The mass (kg) of the grain in a row; NaN where the file does not say a mass that a grain can have.
double GrainMeaning::mass_in(const RawTable& table, std::size_t row, double radius) const {
    const double mass = mass_ ? value(table, mass_, row) * units_.mass
                              : value(table, density_, row) * units_.density() * volume_of(radius);
    return mass > 0 && std::isfinite(mass) ? mass : kUnknown;
}

void GrainMeaning::add_shape(const RawTable& table, std::size_t row, const std::string& place,
                             State& state) const {
    const GrainShape shape = shapes_.shape(table, row, place_unit_);
    if (!is_possible(shape) || shape.half.maxCoeff() > kLargestRadius)
        throw UserError(
            "{}: the grain in row {} has the half lengths {:g}, {:g}, {:g} m and the powers {:g} "
            "and {:g}, which no "
            "grain has (lengths are above 0, powers from 2 to {:g}); mend the row, or let "
            "--radius draw all grains as "
            "spheres",
            place, row + 1, shape.half.x(), shape.half.y(), shape.half.z(), shape.along, shape.around,
            kMostBlockiness);
    state.shape.push_back(shape);
    state.radius.push_back(radius_by_volume(shape));
}

void GrainMeaning::add_grain(const RawFrame& raw, std::size_t row, const std::string& place, State& state,
                             Gaps& gaps) const {
    const RawTable& table = raw.grains;
    const std::int32_t id = state.id.back();
    const Vec3 where = place_of(raw, row);
    if (!where.allFinite()) throw UserError("{}: grain {} has no finite place", place, id);
    if (where.cwiseAbs().maxCoeff() > kFarthestPlace)
        throw UserError(
            "{}: grain {} is at ({:.3g}, {:.3g}, {:.3g}) m, where no bed reaches; is "
            "the file damaged, or are its units others (--units)?",
            place, id, where.x(), where.y(), where.z());
    if (has_shapes())
        add_shape(table, row, place, state);
    else
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
            throw UserError("{}: row {} has the id {}, which is no whole number from 0 to {:.0f}", place,
                            row + 1, number, kMostId);
        ids[row] = static_cast<std::int32_t>(number);
    }
    const std::vector<std::size_t> order = rows_by_id(ids);
    State frame;
    std::vector<std::pair<double, std::size_t>> known;  // types so far, and their species
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t row = order[i];
        if (i > 0 && ids[order[i - 1]] == ids[row])
            throw UserError("{}: grain {} comes twice; a grain has one row in each frame", place, ids[row]);
        // Making the word of a type takes long, so that it is made once.
        const double type = type_ ? value(table, type_, row) : 0;
        auto species = std::find_if(known.begin(), known.end(),
                                    [type](const auto& entry) { return entry.first == type; });
        if (species == known.end()) {
            const std::optional<std::size_t> named = types.place(type_of(raw, row));
            if (!named)
                throw UserError(
                    "{}: grain {} is of type {}, which no frame that was looked at first had; name "
                    "all types by --species",
                    place, ids[row], type_of(raw, row));
            known.emplace_back(type, *named);
            species = std::prev(known.end());
        }
        frame.id.push_back(ids[row]);
        frame.species.push_back(static_cast<std::int32_t>(species->second));
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
                                            const UnitSystem& units, const std::string& file) {
    const RawTable& table = raw.contacts;
    const auto first = column_for("id1", table, options, file),
               second = column_for("id2", table, options, file);
    if (!first || !second) return std::nullopt;
    const auto normal = column_for("force", table, options, file);
    const auto fx = column_for("fx", table, options, file), fy = column_for("fy", table, options, file),
               fz = column_for("fz", table, options, file);
    const auto value_at = [&](std::size_t column, std::size_t row) {
        return table.columns[column].values[row];
    };
    std::vector<Link> touches;
    for (std::size_t row = 0; row < table.rows; ++row) {
        Link touch{};
        const double a = value_at(*first, row), b = value_at(*second, row);
        if (!(std::abs(a) <= kMostId && std::abs(b) <= kMostId)) continue;
        touch.first = static_cast<std::int32_t>(a);
        touch.second = static_cast<std::int32_t>(b);
        if (touch.first < 0) std::swap(touch.first, touch.second);
        if (touch.first < 0) continue;  // a contact of two walls
        if (normal)
            touch.force = std::abs(value_at(*normal, row)) * units.force();
        else if (fx && fy && fz)
            touch.force =
                Vec3(value_at(*fx, row), value_at(*fy, row), value_at(*fz, row)).norm() * units.force();
        if (std::isfinite(touch.force)) touches.push_back(touch);
    }
    return touches;
}

}  // namespace grainreel
