#include "render/run/moments/displacement.hpp"

#include "engine/base/nearest_image.hpp"

namespace grainreel {

void set_displacement(Frame& now, const Frame& before, int periods, double depth) {
    if (before.position.size() != now.size()) return;
    now.displacement.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        Vec3 way = now.position[i] - before.position[i];
        way.x() = nearest_image(way.x(), depth);
        now.displacement[i] = way / periods;
    }
}

}  // namespace grainreel
