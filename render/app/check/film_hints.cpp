// What `check` says about a film that may fail to show what its scene is about.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/lists.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// Whether the species is an intruder: a few large grains among many smaller ones, which are in front of it.
bool may_be_buried(const FilmedScene& scene, std::size_t intruder, std::vector<std::size_t>& before) {
    constexpr std::int64_t few = 5, many = 20;  // grains; small ones for each large one
    constexpr double larger = 1.5;
    const Species& large = scene.species[intruder];
    if (large.all() == 0 || large.all() > few) return false;
    std::int64_t small = 0;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        if (i == intruder || scene.species[i].all() == 0) continue;
        if (scene.species[i].diameter.largest * larger > large.diameter.smallest) return false;
        small += scene.species[i].all();
        before.push_back(i);
    }
    const double room = scene.container.depth - large.diameter.largest;
    return small >= many * large.all() && !before.empty() &&
           room > scene.species[before.front()].diameter.smallest;
}

}  // namespace

std::vector<std::string> film_hints(const FilmedScene& scene) {
    std::vector<std::string> hints;
    const FilmShows& shows = scene.film.shows;
    if (scene.film.look.cut.present) return hints;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        std::vector<std::size_t> before;
        if (contains(shows.hidden, i) || contains(shows.ghosts, i) || !may_be_buried(scene, i, before))
            continue;
        std::erase_if(before, [&](std::size_t one) {
            return contains(shows.ghosts, one) || contains(shows.hidden, one);
        });
        if (before.empty()) continue;
        std::string names;
        for (const std::size_t one : before)
            names += (names.empty() ? "\"" : ", \"") + scene.species[one].name + "\"";
        hints.push_back(
            fmt::format("{}: \"{}\" may be hidden by the grains before it; film.ghost = [{}] shows it "
                        "through them",
                        scene.where(fmt::format("species[{}]", i)), scene.species[i].name, names));
    }
    return hints;
}

}  // namespace grainreel
