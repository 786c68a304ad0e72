#include "render/scene/plain_film.hpp"

#include "render/scene/colours.hpp"

namespace grainreel {

FilmedScene with_plain_film(const Scene& scene) {
    FilmedScene filmed{scene, {}, {}};
    while (filmed.colours.size() < scene.species.size())
        filmed.colours.push_back(default_colour(filmed.colours));
    return filmed;
}

}  // namespace grainreel
