#include "engine/lab/bench/scene_cases.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/base/random.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/scene_surroundings.hpp"

namespace grainreel {

const char* wedge_scene() {
    return R"(title = "Big and small grains in a vibrated wedge hopper"
gravity = "9.81 m/s2"
[[species]]
name = "small"
count = 1500
diameter = "6 mm"
density = "2.5 g/cm3"
[[species]]
name = "big"
count = 120
diameter = "14 mm"
density = "2.5 g/cm3"
[contact]
restitution = 0.9
friction = 0.5
[container]
shape = "wedge"
half_angle = "20 deg"
slant_height = "100 mm"
half_width = "66 mm"
depth = "58 mm"
height = "230 mm"
top = "lid"
outlet = "closed"
[drive]
frequency = "12 Hz"
g_level = 3
ramp = 3
[run]
duration = "10 s"
)";
}

namespace {

BenchBed bed_of(const Scene& scene) {
    BenchBed bed;
    bed.plan = make_plan(scene);
    bed.around = make_surroundings(scene, bed.plan);
    return bed;
}

// More grains: a deeper hopper.
BenchBed wedge(int particles) {
    const double share = particles / 1620.0;
    const Scene scene = read_scene_text(wedge_scene(), "wedge.toml",
                                        {fmt::format("species[0].count={}", std::lround(1500 * share)),
                                         fmt::format("species[1].count={}", std::lround(120 * share)),
                                         fmt::format("container.depth={}", 0.058 * share)});
    BenchBed bed = bed_of(scene);
    bed.grains = place_in_layers(scene);
    Team team(1);
    grow_radii(scene, bed.plan, bed.around, bed.grains, team, [](double, std::int64_t) { return true; });
    return bed;
}

// A box on the floor of the scene, centred in x and y; m. `species` and `rest` are further text of the scene.
BenchBed box(const std::string& name, const Vec3& size, const std::string& species, const std::string& rest) {
    return bed_of(read_scene_text(fmt::format(R"({3}
[container]
shape = "box"
width = {0}
depth = {1}
height = {2}
[run]
duration = 1
{4})",
                                              size.x(), size.y(), size.z(), species, rest),
                                  name, {}));
}

// Small grains of 1 mm on a loose lattice in a box 40 of them wide; the big one takes the place of those
// that it would touch, low in the middle.
constexpr double small = 0.001, apart = 1.1 * small, wide = 0.044;  // m

BenchBed sea(int particles, double big) {
    BenchBed bed = box("sea.toml", {wide, wide, 0.5},
                       fmt::format(R"(
[[species]]
name = "small"
count = {}
diameter = {}
density = 2500
[[species]]
name = "big"
count = 1
diameter = {}
density = 2500
[contact]
restitution = 0.9
friction = 0.5)",
                                   particles, small, big),
                       "[drive]\nfrequency = 25\ng_level = 3\n");
    const int across = static_cast<int>(wide / apart);
    const Vec3 centre(0, 0, big / 2 + 5 * apart);
    Random random(1, Stream::centres);
    bed.grains.reserve(particles);
    bed.grains.add(0, 1, centre, big / 2, 2500);
    for (int site = 0; static_cast<int>(bed.grains.size()) < particles; ++site) {
        const Vec3 corner(-wide / 2, -wide / 2, 0);
        const auto shift = [&] { return 0.5 + random.between(-0.03, 0.03); };
        const Vec3 at = corner + apart * Vec3(site % across + shift(), site / across % across + shift(),
                                              site / (across * across) + shift());
        if ((at - centre).norm() < (big + small) / 2 * 1.01) continue;
        bed.grains.add(static_cast<std::int32_t>(bed.grains.size()), 0, at, small / 2, 2500);
    }
    return bed;
}

// A twentieth of the space is solid; elastic walls and nearly elastic grains keep it a gas.
BenchBed gas(int particles) {
    const double edge = small * std::cbrt(particles * std::numbers::pi / 6 / 0.05);
    BenchBed bed = box("gas.toml", {edge, edge, edge},
                       fmt::format(R"(
gravity = 0
[[species]]
name = "grain"
count = {}
diameter = {}
density = 2500
[contact]
restitution = 0.99
friction = 0.1
stiffness = 1000)",
                                   particles, small),
                       "");
    const int across = static_cast<int>(std::ceil(std::cbrt(particles)));
    Random random(1, Stream::centres);
    bed.grains.reserve(particles);
    const auto speed = [&] { return random.between(-0.5, 0.5); };
    for (int site = 0; site < particles; ++site) {
        const Vec3 corner(-edge / 2, -edge / 2, 0);
        const Vec3 at = corner + edge / across *
                                     Vec3(site % across + 0.5, site / across % across + 0.5,
                                          site / (across * across) + 0.5);
        bed.grains.add(site, 0, at, small / 2, 2500);
        bed.grains.motion.back().velocity = Vec3(speed(), speed(), speed());
    }
    return bed;
}

}  // namespace

std::vector<BenchCase> scene_cases() {
    constexpr int sea_of = 20000;
    return {{"wedge",
             "the hopper of the default film",
             1620,
             -20000,
             20000,
             20,
             {{"settled", 20000}, {"vibrated", 40000}},
             wedge},
            {"intruder",
             "one grain 20 times as large as the others",
             sea_of,
             -20000,
             20000,
             20,
             {{"settled", 3000}, {"vibrated", 10000}},
             [](int n) { return sea(n, 20 * small); }},
            {"sea",
             "the same with one that is no larger: what the large one costs",
             sea_of,
             -20000,
             20000,
             20,
             {{"settled", 3000}, {"vibrated", 10000}},
             [](int n) { return sea(n, small); }},
            {"gas", "a twentieth of the space solid, no gravity", 10000, 0, 2000, 0, {{"gas", 20000}}, gas}};
}

}  // namespace grainreel
