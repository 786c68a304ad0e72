// Tests of the cases of the verb `bench`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/lab/bench/bench_case.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

TEST(WedgeCase, IsTheBedOfWedgeMixing) {
    Scene film = read_scene(fmt::format("{}/scenes/wedge_mixing.toml", GRAINREEL_SOURCE), {});
    const Scene timed = read_scene_text(wedge_scene(), "wedge.toml", {});
    film.title = timed.title, film.film_text = timed.film_text;
    for (std::size_t s = 0; s < film.species.size(); ++s)
        film.species[s].colour_text = timed.species[s].colour_text;
    EXPECT_EQ(resolved_scene(film, make_plan(film)), resolved_scene(timed, make_plan(timed)));
}

// The first run of a process reads units and keys, which stay in memory; later runs find them there.
TEST(WedgeCase, CountsTheMemoryOfItsBedAlone) {
    const auto& all = bench_cases();
    const auto& wedge =
        *std::find_if(all.begin(), all.end(), [](const BenchCase& c) { return c.name == "wedge"; });
    BenchRequest request;
    request.threads = 1;
    request.quick = true;
    const auto go_on = [](auto&&...) { return true; };
    const double first = run_bench(wedge, request, go_on).result.bytes_per_particle;
    const double second = run_bench(wedge, request, go_on).result.bytes_per_particle;
    EXPECT_NEAR(first / second, 1, 0.1) << first << ' ' << second;
}

// A grain of a bed at rest has four to five contacts, each shared by two grains. A falling grain has less
// than one.
TEST(RestCase, IsABedAtRest) {
    const auto& all = bench_cases();
    const auto& rest =
        *std::find_if(all.begin(), all.end(), [](const BenchCase& c) { return c.name == "rest"; });
    BenchRequest request;
    request.threads = 1;
    request.particles = 600;
    request.quick = true;
    const BenchResult result = run_bench(rest, request, [](auto&&...) { return true; }).result;
    ASSERT_EQ(result.phases.size(), 1u);
    EXPECT_EQ(result.phases[0].name, "at rest");
    const double contacts =
        2 * static_cast<double>(result.phases[0].touching) / static_cast<double>(result.particles);
    EXPECT_GT(contacts, 3.5);
    EXPECT_LT(contacts, 5.5);
}

}  // namespace
}  // namespace grainreel
