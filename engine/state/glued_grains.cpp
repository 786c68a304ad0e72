#include "engine/state/glued_grains.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

// A face as a rectangle, which is rolled up for a cylinder's wall. If the face is no rectangle, this one
// covers more than the face.
struct Patch {
    double length = 0, height = 0;                   // m
    bool closed = false;                             // true if its end along the length meets its beginning
    std::function<Vec3(double, double)> point;       // m, point at a distance along length and height
    std::function<bool(const Vec3&, double)> holds;  // whether a grain of this radius (m) may stand there
};

bool everywhere(const Vec3&, double) {
    return true;
}

Patch side_patch(const Container& c, const Face& face) {
    Patch patch;
    patch.length = c.depth;
    patch.closed = c.periodic_depth;
    patch.holds = everywhere;
    const bool wedge = c.shape == Container::Shape::wedge && c.half_angle > 0;
    const double side = face.normal.y() < 0 ? 1 : -1, left = -c.depth / 2;
    if (face.normal.z() != 0) {  // a slant
        const double foot = c.floor_half_width(), sine = math::sin(c.half_angle),
                     cosine = math::cos(c.half_angle);
        patch.height = c.slant_height / cosine;
        patch.point = [=](double a, double b) {
            return Vec3(left + a, side * (foot + b * sine), b * cosine);
        };
        return patch;
    }
    const double low = wedge ? c.slant_height : 0, wide = c.half_width;
    patch.height = c.height - low;
    patch.point = [=](double a, double b) { return Vec3(left + a, side * wide, low + b); };
    return patch;
}

// The patch of the front or the back.
Patch end_patch(const Container& c, const Face& face) {
    Patch patch;
    const double x = face.point.x(), wide = c.half_width;
    patch.length = 2 * wide;
    patch.height = c.height;
    patch.point = [=](double a, double b) { return Vec3(x, a - wide, b); };
    patch.holds = [&c](const Vec3& at, double) { return std::abs(at.y()) <= c.half_width_at(at.z()); };
    return patch;
}

bool clear_of_outlet(const Container& c, const Vec3& at, double radius) {
    if (!c.outlet) return true;
    const bool slot = c.outlet->shape == Outlet::Shape::slot;
    return (slot ? std::abs(at.y()) : math::hypot(at.x(), at.y())) >= c.outlet->half_width + radius;
}

// The patch of the floor or the lid.
Patch level_patch(const Container& c, const Face& face) {
    Patch patch;
    const bool round = c.shape == Container::Shape::cylinder, floor = face.body.number == kFloorBody;
    const double z = face.point.z(), half_depth = round ? c.half_width : c.depth / 2,
                 half_width = c.half_width_at(z);
    patch.length = 2 * half_depth;
    patch.height = 2 * half_width;
    patch.closed = c.periodic_depth;
    patch.point = [=](double a, double b) { return Vec3(a - half_depth, b - half_width, z); };
    patch.holds = [&c, round, floor](const Vec3& at, double radius) {
        if (round && math::hypot(at.x(), at.y()) > c.half_width) return false;
        return !floor || clear_of_outlet(c, at, radius);
    };
    return patch;
}

Patch round_patch(const Container& c) {
    Patch patch;
    const double radius = c.half_width;
    patch.length = 2 * std::numbers::pi * radius;
    patch.height = c.height;
    patch.closed = true;
    patch.point = [=](double a, double b) {
        return Vec3(radius * math::cos(a / radius), radius * math::sin(a / radius), b);
    };
    patch.holds = everywhere;
    return patch;
}

Patch patch_of(const Container& c, const Face& face) {
    if (face.kind == Face::Kind::cylinder) return round_patch(c);
    if (face.normal.x() != 0) return end_patch(c, face);
    return face.normal.y() != 0 ? side_patch(c, face) : level_patch(c, face);
}

// Fills a patch with glued grains. The numbers of rows and of grains in a row are whole, so that the lattice
// fits the patch.
void fill(const Patch& patch, const Scene& scene, const Face& face, std::int32_t number, Random& random,
          GluedGrains& glued) {
    const WallGrains& layer = *scene.container.wall_grains;
    const SizeSpread& spread = scene.species[layer.species].diameter;
    const auto count = [](double length, double step) { return std::max(1.0, std::round(length / step)); };
    const double in_row = count(patch.length, layer.spacing),
                 rows = count(patch.height, layer.spacing * std::sqrt(3.0) / 2);
    const double most = layer.disorder * layer.spacing;
    for (double row = 0; row < rows; ++row)
        for (double k = 0; k < in_row; ++k) {
            const double radius = 0.5 * draw_diameter(spread, random);
            const double shift = std::fmod(row, 2) == 0 ? 0.25 : 0.75;
            double a = (k + shift) * patch.length / in_row + random.between(-most, most);
            const double b = (row + 0.5) * patch.height / rows + random.between(-most, most);
            if (patch.closed) a -= patch.length * std::floor(a / patch.length);
            const Vec3 at = patch.point(std::clamp(a, 0.0, patch.length), std::clamp(b, 0.0, patch.height));
            if (!patch.holds(at, radius)) continue;
            glued.place.push_back({at - face.point, radius});
            glued.face.push_back(number);
        }
}

}  // namespace

GluedGrains glue_grains(const Scene& scene, const std::vector<Face>& faces) {
    GluedGrains glued;
    if (!scene.container.wall_grains) return glued;
    const std::vector<std::string>& rough = scene.container.wall_grains->faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const bool of_container =
            faces[f].body.number == kContainerBody || faces[f].body.number == kFloorBody;
        if (!of_container || !contains(rough, faces[f].name)) continue;
        Random random(scene.run.seed, Stream::wall_grains, {static_cast<std::int64_t>(f)});
        fill(patch_of(scene.container, faces[f]), scene, faces[f], static_cast<std::int32_t>(f), random,
             glued);
    }
    return glued;
}

}  // namespace grainreel
