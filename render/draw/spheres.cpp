#include "render/draw/spheres.hpp"

#include "engine/base/error.hpp"
#include "render/draw/palette.hpp"

namespace grainreel {
namespace {

std::array<float, 3> linear(const Colour& colour) {
    return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
            static_cast<float>(to_linear(colour.blue))};
}

}  // namespace

SpherePainter::SpherePainter(const Scene& scene, int width, int height, int threads)
    : team_(threads), layer_(width, height) {
    for (const Species& species : scene.species) palette_.push_back(linear(species.colour));
}

void SpherePainter::take(const View& view, const Frame& frame) {
    sight_ = {view.orthographic, static_cast<float>(view.focal), 0.5f * static_cast<float>(view.port.width),
              0.5f * static_cast<float>(view.port.height)};
    lamp_.up[0] = static_cast<float>(view.right.z());
    lamp_.up[1] = static_cast<float>(view.up.z());
    lamp_.up[2] = static_cast<float>(view.forward.z());
    spheres_.spheres.resize(frame.size());
    spheres_.albedo.resize(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 at = view.to_view(frame.position[i]);
        spheres_.spheres[i] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                               static_cast<float>(at.z()), static_cast<float>(frame.radius[i])};
        GRAINREEL_CHECK(static_cast<std::size_t>(frame.species[i]) < palette_.size());
        spheres_.albedo[i] = palette_[static_cast<std::size_t>(frame.species[i])];
    }
}

void SpherePainter::find_visible() {
    layer_.find_visible(sight_, cut_, spheres_, team_);
}

void SpherePainter::find_neighbours() {
    layer_.find_neighbours(cut_, lamp_, spheres_, team_);
}

const Layer& SpherePainter::light() {
    return layer_.light(sight_, cut_, lamp_, spheres_, team_);
}

}  // namespace grainreel
