#include "engine/measure/walls/wear_observer.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/numbers.hpp"

namespace grainreel {

WearTally::WearTally(const Scene& scene)
    : bodies_(bodies_of(scene)), first_(static_cast<std::size_t>(first_mesh_body(scene))) {
    for (const SceneMesh& mesh : scene.meshes) {
        const std::vector<double> none(static_cast<std::size_t>(mesh.surface->size()), 0.0);
        sums_.push_back({none, none, none});
    }
}

void WearTally::contact(const ObservedState& m, const ContactView& c) {
    const std::int64_t mesh =
        -1 - static_cast<std::int64_t>(c.second) - static_cast<std::int64_t>(m.faces.size());
    if (c.second >= 0 || c.triangle < 0 || mesh < 0) return;
    const Body& body = bodies_[first_ + static_cast<std::size_t>(mesh)];
    const Motion& grain = m.grains.motion[c.first];
    Vec3 arm = c.point - m.grains.place[c.first].position;
    arm.x() = nearest_image(arm.x(), m.period);
    const Vec3 slip = grain.velocity + grain.spin.cross(arm) - body.at(m.pose).velocity_at(c.point);
    const double press = std::max(0.0, c.normal_force), towards = slip.dot(c.normal);
    seen_.push_back({static_cast<std::size_t>(mesh), static_cast<std::size_t>(c.triangle),
                     m.grains.id[c.first], press, press * std::max(0.0, towards), c.tangential.dot(slip)});
}

void WearTally::add(double time) {
    std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) {
        return std::tie(a.mesh, a.triangle, a.grain, a.press) <
               std::tie(b.mesh, b.triangle, b.grain, b.press);
    });
    for (const Seen& one : seen_) {
        WearSums& sums = sums_[one.mesh];
        sums.press[one.triangle] += time * one.press;
        sums.impact[one.triangle] += time * one.impact;
        sums.shear[one.triangle] += time * one.shear;
    }
}

bool WearTally::fits(const std::vector<WearSums>& sums) const {
    if (sums.size() != sums_.size()) return false;
    for (std::size_t m = 0; m < sums.size(); ++m)
        for (const std::vector<double>* values : {&sums[m].press, &sums[m].impact, &sums[m].shear})
            if (values->size() != sums_[m].press.size() ||
                !std::all_of(values->begin(), values->end(), [](double x) { return std::isfinite(x); }))
                return false;
    return true;
}

}  // namespace grainreel
