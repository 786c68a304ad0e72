#include "render/picture/spheres/light/sphere_layer.hpp"

#include <algorithm>
#include <atomic>

#include "engine/base/processor.hpp"
#include "render/picture/spheres/layer.hpp"

namespace grainreel {

void SphereLayer::find_visible(const Sight& sight, const Cut& cut, const Spheres& spheres, Team& team,
                               const SolidDepth& solid) {
    visibility_.update(sight, cut, spheres.spheres, team, solid);
}

void SphereLayer::find_order(const Sight& sight, const Cut& cut, const Spheres& spheres,
                             const std::vector<WallFace>& faces, Team& team) {
    wall_order_.update(sight, cut, spheres.spheres, faces, visibility_, team);
}

void SphereLayer::find_neighbours(const Cut& cut, const Lamp& lamp, const Spheres& spheres, Team& team) {
    neighbourhood_.update(spheres.spheres, cut, lamp, visibility_.shown(), team);
}

const Layer& SphereLayer::light(const Sight& sight, const Cut& cut, const Lamp& lamp, const Spheres& spheres,
                                Team& team) {
    constexpr int kRows = 16;
    slot_of_.resize(spheres.spheres.size());
    const std::vector<std::uint32_t>& shown = visibility_.shown();
    for (std::size_t slot = 0; slot < shown.size(); ++slot)
        slot_of_[shown[slot]] = static_cast<std::uint32_t>(slot);
    const PaintJob job{sight, cut, lamp, spheres, visibility_, neighbourhood_, slot_of_};
    painters_.resize(static_cast<std::size_t>(team.size()));
    std::atomic<int> next{0};
    team.run([&](int member) {
        const FlushDenormals flush;
        BandPainter& painter = painters_[static_cast<std::size_t>(member)];
        for (int y; (y = kRows * next.fetch_add(1, std::memory_order_relaxed)) < layer_.height;)
            painter.paint(job, y, std::min(y + kRows, layer_.height), layer_);
    });
    for (const WallPixel& pixel : wall_order_.pixels())
        layer_.row(pixel.y)[pixel.x] = faded(layer_.row(pixel.y)[pixel.x], 1 - pixel.hidden);
    return layer_;
}

}  // namespace grainreel
