#include "engine/files/foreign/gsd/gsd_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/numbers.hpp"

namespace grainreel {

namespace {

// A number above 0 by its name; NaN where there is none.
double length_in(const nlohmann::json& shape, const char* name) {
    const auto entry = shape.find(name);
    if (entry == shape.end() || !entry->is_number()) return kUnknown;
    const double number = entry->get<double>();
    return number > 0 && std::isfinite(number) ? number : kUnknown;
}

// The shape of a grain's type; none where there is no such type.
const GsdShape* shape_of_row(const RawTable& grains, const std::vector<GsdShape>& shapes, std::size_t row) {
    const RawColumn* types = grains.find("type");
    const double type = types ? types->values[row] : 0;
    return type >= 0 && type < static_cast<double>(shapes.size()) ? &shapes[static_cast<std::size_t>(type)]
                                                                  : nullptr;
}

}  // namespace

bool GsdShape::is_sphere() const {
    return half && half->x() == half->y() && half->y() == half->z();
}

GsdShape gsd_shape(const std::string& text) {
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    GsdShape shape;
    if (!json.is_object() || !json.contains("type") || !json["type"].is_string()) return shape;
    shape.name = json["type"].get<std::string>();
    Vec3 half = Vec3::Constant(kUnknown);
    if (shape.name == "Sphere") half = Vec3::Constant(0.5 * length_in(json, "diameter"));
    if (shape.name == "Ellipsoid")
        half = Vec3(length_in(json, "a"), length_in(json, "b"), length_in(json, "c"));
    if (half.allFinite()) shape.half = half;
    return shape;
}

bool draws_ellipsoids(const std::vector<GsdShape>& shapes, bool grains_have_diameters) {
    return std::any_of(shapes.begin(), shapes.end(),
                       [](const GsdShape& one) { return one.is_ellipsoid(); }) &&
           (grains_have_diameters ||
            std::all_of(shapes.begin(), shapes.end(), [](const GsdShape& one) { return one.half; }));
}

void add_half_lengths(RawTable& grains, const std::vector<GsdShape>& shapes) {
    const RawColumn* diameters = grains.find("diameter");
    std::array<RawColumn, 3> columns;
    for (std::size_t k = 0; k < 3; ++k) columns[k].name = std::string("type_shapes:") + "abc"[k];
    for (std::size_t row = 0; row < grains.rows; ++row) {
        const GsdShape* shape = shape_of_row(grains, shapes, row);
        const Vec3 half = shape && shape->half
                              ? *shape->half
                              : Vec3::Constant(diameters ? 0.5 * diameters->values[row] : kUnknown);
        for (std::size_t k = 0; k < 3; ++k) columns[k].values.push_back(half[static_cast<Eigen::Index>(k)]);
    }
    for (RawColumn& column : columns) grains.columns.push_back(std::move(column));
    if (grains.find("orientation:0")) return;
    for (int k = 0; k < 4; ++k)
        grains.columns.push_back(
            {"orientation:" + std::to_string(k), std::vector<double>(grains.rows, k == 0 ? 1 : 0), {}});
}

void add_diameters(RawTable& grains, const std::vector<GsdShape>& shapes) {
    RawColumn column{"diameter", {}, {}};
    for (std::size_t row = 0; row < grains.rows; ++row) {
        const GsdShape* shape = shape_of_row(grains, shapes, row);
        column.values.push_back(shape && shape->name == "Sphere" && shape->half ? 2 * shape->half->x()
                                                                                : kUnknown);
    }
    grains.columns.push_back(std::move(column));
}

}  // namespace grainreel
