#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/bench/scene_cases.hpp"
#include "engine/scene/reader.hpp"
#include "engine/scene/writer.hpp"

namespace grainreel {
namespace {

TEST(WedgeCase, IsTheDefaultFilmsBed) {
    Scene film = read_scene(fmt::format("{}/scenes/wedge_segregation.toml", GRAINREEL_SOURCE), {});
    const Scene timed = read_scene_text(wedge_scene(), "wedge.toml", {});
    film.film = timed.film;
    for (std::size_t s = 0; s < film.species.size(); ++s) film.species[s].colour = timed.species[s].colour;
    EXPECT_EQ(resolved_scene(film, make_plan(film)), resolved_scene(timed, make_plan(timed)));
}

}  // namespace
}  // namespace grainreel
