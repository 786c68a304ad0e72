#include "engine/files/foreign/grain_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

constexpr double kHair = 1e-3;  // by which shapes of spheres may differ from spheres, of themselves

std::optional<std::array<std::size_t, 3>> three_columns(const std::array<const char*, 3>& meanings,
                                                        const RawTable& table, const ReadingOptions& options,
                                                        const std::string& file) {
    std::array<std::size_t, 3> columns{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto column = column_for(meanings[k], table, options, file);
        if (!column) return std::nullopt;
        columns[k] = *column;
    }
    return columns;
}

// LIGGGHTS writes half lengths into the columns for which LAMMPS has whole lengths, and names the parts of
// its quaternions otherwise.
bool is_of_liggghts(const RawTable& table) {
    return std::any_of(table.columns.begin(), table.columns.end(), [](const RawColumn& column) {
        return same_word(column.name, "quat1") || same_word(column.name, "blockiness1");
    });
}

}  // namespace

// The extents of a sphere are equal, and its powers are those of an ellipsoid, 2.
ShapeColumns::ShapeColumns(const RawTable& table, const ReadingOptions& options, const std::string& file) {
    extent_ = three_columns({"shapex", "shapey", "shapez"}, table, options, file);
    share_ = extent_ && !is_of_liggghts(table) ? 0.5 : 1;
    if (!extent_) extent_ = three_columns({"semix", "semiy", "semiz"}, table, options, file);
    power_ = {column_for("blockiness1", table, options, file),
              column_for("blockiness2", table, options, file)};
    const auto tells = [&](std::size_t column) { telling_.push_back(table.columns[column].name); };
    if (extent_) {
        const auto of = [&](std::size_t k, std::size_t row) {
            return table.columns[(*extent_)[k]].values[row];
        };
        for (std::size_t row = 0; row < table.rows && telling_.empty(); ++row) {
            const auto [least, most] = std::minmax({of(0, row), of(1, row), of(2, row)});
            if (most - least > kHair * most) std::for_each(extent_->begin(), extent_->end(), tells);
        }
    }
    for (const auto& column : power_) {
        if (!column) continue;
        const std::vector<double>& values = table.columns[*column].values;
        if (std::none_of(values.begin(), values.end(), [](double n) { return std::abs(n - 2) > kHair; }))
            continue;
        blockiness_ = true;
        tells(*column);
    }
    if (!extent_) blockiness_ = false;
}

std::vector<std::size_t> ShapeColumns::all() const {
    std::vector<std::size_t> columns;
    if (extent_) columns.assign(extent_->begin(), extent_->end());
    for (const auto& column : power_)
        if (column) columns.push_back(*column);
    return columns;
}

GrainShape ShapeColumns::shape(const RawTable& table, std::size_t row, double unit) const {
    const auto number = [&](std::size_t column) { return table.columns[column].values[row]; };
    GrainShape shape;
    for (std::size_t k = 0; k < 3; ++k)
        shape.half[static_cast<Eigen::Index>(k)] = share_ * unit * number((*extent_)[k]);
    if (power_[0]) shape.along = number(*power_[0]);
    if (power_[1]) shape.around = number(*power_[1]);
    return shape;
}

}  // namespace grainreel
