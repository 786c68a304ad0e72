#include "engine/state/traffic.hpp"

#include "engine/base/random.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

NewGrain fed_grain(const Scene& scene, std::size_t feed, std::int64_t number) {
    const Feed& from = scene.feeds[feed];
    const Species& species = scene.species[from.species];
    Random random(scene.run.seed, Stream::feed_sizes, {static_cast<std::int64_t>(feed), number});
    NewGrain grain;
    grain.species = static_cast<std::int32_t>(from.species);
    grain.radius = 0.5 * draw_diameter(species.diameter, random);
    grain.density = species.density;
    grain.velocity = from.velocity;
    return grain;
}

}  // namespace grainreel
