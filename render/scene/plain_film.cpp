#include "render/scene/plain_film.hpp"

#include <algorithm>

#include "engine/scene/bed.hpp"
#include "render/scene/colours.hpp"

namespace grainreel {
namespace {

void name_species(const Frame& frame, std::vector<Species>& species) {
    std::vector<bool> counted;
    for (const Species& one : species) counted.push_back(one.all() > 0);
    const auto unknown = [&](std::size_t kind) { return kind >= counted.size() || !counted[kind]; };
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto kind = static_cast<std::size_t>(frame.species[i]);
        while (species.size() <= kind) {
            species.emplace_back();
            species.back().name = "type " + std::to_string(species.size());
        }
        if (unknown(kind)) ++species[kind].count;
        double& largest = species[kind].diameter.largest;
        largest = std::max(largest, 2 * frame.radius[i]);
    }
}

void list_grains(const Frame& frame, Scene& scene) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
        ListedGrain grain;
        grain.species = static_cast<std::size_t>(frame.species[i]);
        grain.position = frame.position[i];
        scene.start.grains.push_back(grain);
    }
    const Vec3 size = extent_of(scene).size();
    scene.container.depth = size.x();
    scene.container.half_width = 0.5 * size.y();
    scene.container.height = size.z();
}

}  // namespace

FilmedScene with_plain_film(const Scene& scene, const Frame& frame) {
    FilmedScene filmed{scene, {}, {}};
    name_species(frame, filmed.species);
    if (filmed.container.shape == Container::Shape::none && filmed.start.grains.empty())
        list_grains(frame, filmed);
    while (filmed.colours.size() < filmed.species.size())
        filmed.colours.push_back(default_colour(filmed.colours));
    return filmed;
}

}  // namespace grainreel
