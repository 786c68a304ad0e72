#include "engine/scene/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

bool in_container(const Container& c, const Vec3& place, double margin) {
    if (c.shape == Container::Shape::mesh) {
        const bool below_rim = place.z() <= c.height - (c.lid ? margin : 0);
        return below_rim && (margin > 0 ? c.room->holds(place, margin) : c.room->holds(place));
    }
    if (place.z() < margin || place.z() > c.height - margin) return false;
    if (c.shape == Container::Shape::cylinder)
        return std::hypot(place.x(), place.y()) <= c.half_width - margin;
    const bool slanted = c.shape == Container::Shape::wedge && place.z() < c.slant_height;
    const double slope = slanted ? std::cos(c.half_angle) : 1;
    if (std::abs(place.y()) > c.half_width_at(place.z()) - margin / slope) return false;
    return c.periodic_depth || std::abs(place.x()) <= c.depth / 2 - margin;
}

// Numbers in [0, 1) that fill a cube evenly (the additive recurrence R3, after M. Roberts 2018: powers of
// 1/g, g^4 = g + 1).
Vec3 evenly(int k) {
    constexpr double g = 1.2207440846057596;
    const auto part = [&](double step) { return std::fmod(0.5 + step * k, 1.0); };
    return {part(1 / g), part(1 / (g * g)), part(1 / (g * g * g))};
}

// Whether a level ray leaves the closed surface an odd number of times.
bool is_inside(const Surface& surface, const Vec3& place) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(place, Vec3(1, 0, 0), hits);
    return hits.size() % 2 == 1;
}

}  // namespace

bool FreeSpace::in_room(const Vec3& place, double margin) const {
    if (region_ && !region_->holds(place, margin)) return false;
    return container_.shape == Container::Shape::none || in_container(container_, place, margin);
}

bool FreeSpace::before_planes(const Vec3& place, double margin) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const FreeWall& plane) {
        return plane.normal.dot(place - plane.point) >= margin;
    });
}

bool FreeSpace::off_meshes(const Vec3& place, double margin) const {
    return std::none_of(meshes_.begin(), meshes_.end(), [&](const Shared<Surface>& mesh) {
        if (margin > 0 && mesh->any_within(place, margin)) return true;
        return !region_ && mesh->facts().closed() && is_inside(*mesh, place);
    });
}

bool FreeSpace::holds(const Vec3& place, double margin) const {
    return in_room(place, margin) && before_planes(place, margin) && off_meshes(place, margin);
}

FreeSpace::FreeSpace(const Scene& scene)
    : container_(scene.container), region_(scene.start.region), planes_(scene.walls) {
    for (const SceneMesh& mesh : scene.meshes)
        if (&mesh != scene.vessel()) meshes_.push_back(mesh.surface);
    volume_ = region_ ? region_->volume() : container_.volume();
    set_box(scene);
    if (region_ || !planes_.empty() || !meshes_.empty()) measure();
}

void FreeSpace::set_box(const Scene& scene) {
    if (region_) {
        low_ = region_->low, high_ = region_->high;
    } else if (const SceneMesh* vessel = scene.vessel()) {
        const MeshFacts& facts = vessel->surface->facts();
        low_ = Vec3(facts.low.x(), facts.low.y(), container_.base());
        high_ = Vec3(facts.high.x(), facts.high.y(), container_.height);
    } else {
        const bool round = container_.shape == Container::Shape::cylinder;
        const double half_depth = round ? container_.half_width : container_.depth / 2;
        low_ = Vec3(-half_depth, -container_.half_width, 0);
        high_ = Vec3(half_depth, container_.half_width, container_.height);
    }
}

void FreeSpace::measure() {
    // A place in a mesh's room costs sixteen rays, and one beside a solid a ray.
    const bool dear = container_.shape == Container::Shape::mesh ||
                      std::any_of(meshes_.begin(), meshes_.end(),
                                  [](const Shared<Surface>& mesh) { return mesh->facts().closed(); });
    const int places = dear ? 10'000 : 100'000;
    measured_ = true;
    int inside = 0;
    for (int k = 0; k < places; ++k) {
        const Vec3 place = low_ + evenly(k).cwiseProduct(high_ - low_);
        const bool there = in_room(place, 0);
        if (!there && !region_) continue;
        ++inside;  // in the container, or in the box, whose volume is known
        if (there && before_planes(place, 0) && off_meshes(place, 0)) heights_.push_back(place.z());
    }
    std::sort(heights_.begin(), heights_.end());
    volume_ *= static_cast<double>(heights_.size()) / std::max(inside, 1);
}

double FreeSpace::height_of_share(double part) const {
    if (measured_) {
        if (heights_.empty()) return 0;
        const double at = part * static_cast<double>(heights_.size() - 1);
        return heights_[static_cast<std::size_t>(at)];
    }
    const double wanted = part * volume_;
    double low = container_.base(), high = container_.height;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (container_.volume_below(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace grainreel
