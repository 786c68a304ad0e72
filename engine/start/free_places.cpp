#include "engine/start/free_places.hpp"

#include <algorithm>

#include "engine/base/numbers.hpp"

namespace grainreel {
namespace {

constexpr int kDraws = 200;
constexpr double kGap = 1e-3;  // over the radius

}  // namespace

FreePlaces::FreePlaces(const Surroundings& around, const Pose& pose, const Grains& grains, const Vec3& low,
                       const Vec3& high, double largest)
    : around_(around), pose_(pose), low_(low), high_(high) {
    const auto take = [&](const Place& place) {
        const double reach = place.radius + largest * (1 + kGap);
        const Vec3& centre = place.position;
        const bool outside = centre.y() < low.y() - reach || centre.y() > high.y() + reach ||
                             centre.z() < low.z() - reach || centre.z() > high.z() + reach;
        if (!outside) near_.push_back(place);
    };
    for (const Place& place : grains.place) take(place);
    for (std::size_t g = 0; g < around.glued.size(); ++g)
        take({around.glued.centre(g, around.faces, pose), around.glued.place[g].radius});
    for (const MeshWall& mesh : around.meshes) meshes_.push_back(mesh.body.at(pose));
}

bool FreePlaces::is_free(const Vec3& place, double radius) const {
    const double wide = radius * (1 + kGap);
    for (const Face& face : around_.faces)
        if (distance_at(face, pose_, place).distance < wide) return false;
    for (std::size_t m = 0; m < meshes_.size(); ++m)
        if (around_.meshes[m].surface->any_within(meshes_[m].at_rest(place), wide)) return false;
    if (holds_ && !holds_(place)) return false;
    return std::none_of(near_.begin(), near_.end(), [&](const Place& other) {
        Vec3 between = place - other.position;
        between.x() = wrapped(between.x(), around_.period);
        return between.squaredNorm() < (other.radius + wide) * (other.radius + wide);
    });
}

std::optional<Vec3> FreePlaces::take(double radius, Random& random) {
    for (int draw = 0; draw < kDraws; ++draw) {
        Vec3 place;
        for (int axis = 0; axis < 3; ++axis) place[axis] = random.between(low_[axis], high_[axis]);
        if (!is_free(place, radius)) continue;
        near_.push_back({place, radius});
        return place;
    }
    return std::nullopt;
}

}  // namespace grainreel
