#include "engine/start/layers.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/start/starting_room.hpp"

namespace grainreel {

namespace {

double mean_diameter(const Species& s) {
    return 0.5 * (s.diameter.smallest + s.diameter.largest);
}

}  // namespace

Grains place_in_layers(const Scene& scene) {
    if (scene.grains_at_start() == 0) return {};
    std::vector<std::size_t> upwards(scene.species.size());
    std::iota(upwards.begin(), upwards.end(), std::size_t{0});
    std::stable_sort(upwards.begin(), upwards.end(), [&](std::size_t a, std::size_t b) {
        return mean_diameter(scene.species[a]) > mean_diameter(scene.species[b]);
    });
    double all = 0;
    for (const Species& s : scene.species) all += solid_volume_at_start(s);
    const StartingRoom room(scene);
    const FreeSpace& space = room.space;
    std::vector<double> bottom(scene.species.size()), top(scene.species.size());
    double share = 0;
    for (const std::size_t s : upwards) {
        bottom[s] = space.height_of_share(room.filled * share);
        share += solid_volume_at_start(scene.species[s]) / all;
        top[s] = space.height_of_share(room.filled * std::min(share, 1.0));
    }

    Random diameters(scene.run.seed, Stream::diameters), centres(scene.run.seed, Stream::centres);
    Grains grains;
    grains.reserve(scene.grains());
    std::int32_t id = 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        const Species& species = scene.species[s];
        for (std::int64_t k = 0; k < species.count; ++k) {
            const double radius = 0.5 * draw_diameter(species.diameter, diameters);
            const double off = scene.meshes.empty() ? 0.25 : 0.5;  // no mesh pushes grains back
            const double margin = std::min(off * radius, 0.25 * (top[s] - bottom[s]));
            const Vec3 centre = room.random_centre(bottom[s], top[s], margin, radius, centres);
            grains.add(id++, static_cast<std::int32_t>(s), centre, radius, species.density);
        }
    }
    return grains;
}

}  // namespace grainreel
