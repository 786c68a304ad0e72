#include "engine/measure/walls/wall_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "engine/scene/output.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

constexpr int kMostSlices = 100;

double largest_radius(const Scene& scene) {
    double largest = 0;
    for (const Species& species : scene.species) largest = std::max(largest, 0.5 * species.diameter.largest);
    return largest;
}

// Each two diameters of the largest grain high, about.
int slices_of(const Scene& scene) {
    if (scene.container.shape == Container::Shape::none || scene.container.shape == Container::Shape::mesh)
        return 0;
    if (scene.container.turn) return 0;  // its walls stand nowhere
    const double slices = scene.container.height / (4 * largest_radius(scene));
    return static_cast<int>(std::clamp(std::round(slices), 1.0, double{kMostSlices}));
}

}  // namespace

double area_between(const Container& c, const std::string& face, double low, double high) {
    const bool wedge = c.shape == Container::Shape::wedge && c.half_angle > 0;
    const double edge = wedge ? c.slant_height : 0;
    const auto part = [&](double from, double to) {
        return std::max(0.0, std::min(high, to) - std::max(low, from));
    };
    if (face == "wall") return 2 * std::numbers::pi * c.half_width * part(0, c.height);
    if (face.ends_with(" slant")) return c.depth * part(0, edge) / std::cos(c.half_angle);
    if (face.ends_with(" wall")) return c.depth * part(edge, c.height);
    if (face != "front" && face != "back") return 0;
    const double slanted = part(0, edge), middle = 0.5 * (std::max(low, 0.0) + std::min(high, edge));
    const double half = wedge ? c.half_width - (edge - middle) * std::tan(c.half_angle) : 0;
    return 2 * (slanted * half + part(edge, c.height) * c.half_width);
}

WallScale wall_scale(const Scene& scene, const Plan& plan) {
    double stiffest = 0;
    for (const std::vector<PairPlan>* walls : {&plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& wall : *walls)
            stiffest = std::max({stiffest, wall.loading_stiffness, wall.unloading_stiffness});
    WallScale scale;
    scale.force = std::exp2(std::floor(std::log2(stiffest * largest_radius(scene))) - 48);
    scale.length = std::exp2(std::ceil(std::log2(extent_of(scene).size().norm())));
    scale.slices = slices_of(scene);
    scale.slice = scale.slices > 0 ? scene.container.height / scale.slices : 0;
    scale.period = period_of_depth(scene.container);
    return scale;
}

PressureProfile::PressureProfile(const Scene& scene) {
    const int slices = slices_of(scene);
    const double slice = slices > 0 ? scene.container.height / slices : 0;
    FieldAxis height{"height", "m", "above the floor at rest, in the frame of the container", {}};
    for (int s = 0; s < slices; ++s) height.at.push_back((s + 0.5) * slice);
    fields_.axes.push_back(height);
    const std::vector<Face> faces = container_faces(scene.container, scene.drive);
    const std::vector<std::string> names = face_names(scene);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::vector<double> area;
        for (int s = 0; s < slices; ++s)
            area.push_back(area_between(scene.container, faces[f].name, s * slice, (s + 1) * slice));
        if (std::all_of(area.begin(), area.end(), [](double a) { return a == 0; })) continue;
        fields_.fields.push_back({"pressure_" + names[f],
                                  "pressure on " + faces[f].name,
                                  "Pa",
                                  "mean normal force over area, of every step of the record",
                                  {"height"}});
        faces_.push_back(f);
        area_.push_back(std::move(area));
    }
}

FieldValues PressureProfile::pressures(const std::vector<double>& normal) const {
    FieldValues values;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
        std::vector<double>& profile = values.emplace_back();
        for (std::size_t s = 0; s < area_[k].size(); ++s)
            profile.push_back(area_[k][s] > 0 ? normal[faces_[k] * area_[k].size() + s] / area_[k][s]
                                              : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
}

}  // namespace grainreel
