#include "engine/files/foreign/grain_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

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
        if (same_word(column.name, name)) return &column;
    return nullptr;
}

}  // namespace

// The extents of a sphere are equal, and its blockiness is that of an ellipsoid, 2.
std::vector<std::string> columns_of_other_shapes(const RawTable& table) {
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
    return names;
}

}  // namespace grainreel
