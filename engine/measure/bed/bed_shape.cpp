#include "engine/measure/bed/bed_shape.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

double solid_fraction(const Container& container, const Grains& grains, double floor, double top) {
    const double height = std::min(top - floor, container.height);
    if (container.shape == Container::Shape::none || !(height > container.base())) return kNoValue;
    double solid = 0;
    for (const Place& p : grains.place) {
        const double r = p.radius, cap = std::clamp(floor + height - (p.position.z() - r), 0.0, 2 * r);
        solid += std::numbers::pi * cap * cap * (3 * r - cap) / 3;
    }
    return solid / container.volume_below(height);
}

double Fabric::anisotropy() const {
    if (contacts_ == 0) return kNoValue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.compute(tensor(), Eigen::EigenvaluesOnly);
    const Vec3 rising = solver.eigenvalues();
    return rising[2] - rising[0];
}

std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains) {
    if (scene.species.size() < 2) return std::nullopt;
    const auto big = static_cast<std::int32_t>(big_and_small(scene.species).big);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        if (grains.species[i] != big) continue;
        if (found) return std::nullopt;
        found = i;
    }
    return found;
}

double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor) {
    const double period = period_of_depth(scene.container);
    const Place& own = grains.place[intruder];
    double diameters = 0;
    for (const Place& p : grains.place) diameters += 2 * p.radius;
    const double mean = (diameters - 2 * own.radius) / static_cast<double>(grains.size() - 1);
    const double reach = own.radius + 2 * mean;
    std::vector<Place> around;  // places relative to the intruder's in x and y
    for (std::size_t i = 0; i < grains.size(); ++i) {
        Place p = grains.place[i];
        p.position.x() = nearest_image(p.position.x() - own.position.x(), period);
        p.position.y() -= own.position.y();
        const bool near = std::abs(p.position.x()) < reach && std::abs(p.position.y()) < reach;
        if (i != intruder && near) around.push_back(p);
    }
    if (around.empty()) return kNoValue;
    const BedOutline surface = surface_of(around, {-reach, reach, -reach, reach, 0, mean});
    return (own.position.z() + own.radius - floor) / (surface.mean() - floor);
}

}  // namespace grainreel
