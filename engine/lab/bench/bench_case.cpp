#include "engine/lab/bench/bench_case.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/random.hpp"
#include "engine/base/team.hpp"
#include "engine/lab/bench/peers_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

const std::vector<BenchCase>& bench_cases() {
    static const std::vector<BenchCase> all = [] {
        std::vector<BenchCase> cases = peers_cases();
        for (BenchCase& scene : scene_cases()) cases.push_back(scene);
        cases.push_back(rest_case());
        return cases;
    }();
    return all;
}

BenchBed copied(const BenchBed& bed, const Grains& grains, double side, int k) {
    BenchBed whole{bed.plan, bed.around, {}};
    for (Face& face : whole.around.faces) {
        if (std::abs(face.normal.z()) < 0.5) face.point.head<2>() *= k;
    }
    const auto n = static_cast<std::int32_t>(grains.size());
    whole.grains.reserve(grains.size() * k * k);
    const double first = -0.5 * (k - 1);
    for (int copy = 0; copy < k * k; ++copy) {
        const Vec3 shift(side * (first + copy % k), side * (first + copy / k), 0);
        for (std::int32_t i = 0; i < n; ++i) {
            whole.grains.id.push_back(copy * n + grains.id[i]);
            whole.grains.species.push_back(grains.species[i]);
            whole.grains.place.push_back(grains.place[i]);
            whole.grains.place.back().position += shift;
            whole.grains.motion.push_back(grains.motion[i]);
            whole.grains.load.push_back({});
            whole.grains.wall_work.push_back(0);
        }
    }
    return whole;
}

// The peers' bed with their law, with ours, and without friction.

namespace {

constexpr int kAllGrains = 10125, kBigGrains = 1125;

// The peers' bed with so many grains. Fewer grains stand in a narrower box, as high as the whole bed.
BenchBed bed_of(int particles, const Plan& plan) {
    const int count = std::min(particles, kAllGrains), big = count * kBigGrains / kAllGrains;
    const double side = 0.02 * std::sqrt(count / static_cast<double>(kAllGrains));
    const PeersBed bed = peers_bed(7, count - big, big, side);
    return {plan, peers_surroundings(bed, plan), peers_grains(bed)};
}

// The peers' plan in Walton and Braun's law, with the same stiffness, restitution and step.
Plan walton_braun(TangentialLaw tangential) {
    Plan plan = peers_plan();
    for (auto* kinds : {&plan.grain, &plan.wall}) {
        for (PairPlan& pair : *kinds) {
            pair.model.normal = NormalForce::walton_braun_corrected;
            pair.model.tangential = tangential;
            pair.restitution = 0.9;
            pair.unloading_stiffness = pair.loading_stiffness / (0.9 * 0.9);
            pair.tangential_stiffness = 0.8 * pair.loading_stiffness;
            pair.gamma = 1.0 / 3;
            if (tangential == TangentialLaw::none) pair.friction = 0;
        }
    }
    return plan;
}

double side(const BenchBed& bed) {
    double widest = 0;
    for (const Face& face : bed.around.faces) widest = std::max(widest, std::abs(face.point.x()));
    return 2 * widest;
}

BenchCase like_the_peers(const std::string& name, const std::string& about, BenchBed (*bed)(int)) {
    return {
        name, about, kAllGrains, -60000, 0, 0, {{"settled", 60000}, {"rising", 10000}, {"vibrated", 20000}},
        bed,  side};
}

}  // namespace

std::vector<BenchCase> peers_cases() {
    return {
        like_the_peers("bed10k", "the peers' bed: spring-dashpot with friction, in three phases",
                       [](int n) { return bed_of(n, peers_plan()); }),
        like_the_peers("bed10k-walton-braun", "the same with Walton-Braun, corrected, and incremental slip",
                       [](int n) { return bed_of(n, walton_braun(TangentialLaw::incremental_slip)); }),
        like_the_peers("frictionless", "the same with Walton-Braun, corrected, without friction",
                       [](int n) { return bed_of(n, walton_braun(TangentialLaw::none)); })};
}

namespace {

constexpr int kPart = 2500;            // grains of one part; the whole bed is made of copies of it
constexpr double kDiameter = 1e-3;     // m
constexpr double kAcross = 10.5;       // width of a part in diameters; it is then about 28 diameters deep
constexpr std::int64_t kFall = 30000;  // steps of the fall until the grains lie still, with drag
constexpr double kDrag = 20;           // 1/s

// Grains with the laws of Hertz and Mindlin. They are soft, so that the step is long; the cost of a step does
// not depend on the stiffness.
Scene scene_of_part(int grains) {
    const double side = kAcross * kDiameter * std::sqrt(grains / static_cast<double>(kPart));
    return read_scene_text(fmt::format(R"(
[[species]]
name = "grain"
count = {0}
diameter = {1}
density = 2500
[contact]
law = "hertz"
modulus = 1e6
restitution = 0.7
friction = 0.5
[container]
shape = "box"
width = {2}
depth = {2}
height = 0.08
[run]
duration = 1
)",
                                       grains, kDiameter, side),
                           "rest.toml", {});
}

// Copies of a part, side by side. At the seams the grains of two copies lie as they lay at the wall.
BenchBed bed_at_rest(int particles) {
    const int k =
        std::max(1, static_cast<int>(std::lround(std::sqrt(particles / static_cast<double>(kPart)))));
    const Scene scene = scene_of_part(particles / (k * k));
    BenchBed part;
    part.plan = make_plan(scene);
    part.around = make_surroundings(scene, part.plan);
    part.grains = place_in_layers(scene);
    Team team(1);
    grow_radii(scene, part.plan, part.around, part.grains, team, [](double, std::int64_t) { return true; });
    StepLoop loop(part.plan, part.around, part.grains, team);
    loop.restart();
    loop.run(-kFall, kFall, part.plan.clock.step, kDrag);
    return copied(part, part.grains, 2 * scene.container.half_width, k);
}

}  // namespace

BenchCase rest_case() {
    return {"rest",
            "a bed at rest, Hertz-Mindlin: all contacts at once",
            25000,
            0,
            6000,
            kDrag,
            {{"at rest", 3000}},
            bed_at_rest};
}

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

// The hopper of the default film, deeper for more grains.
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

// A bed in a box on the floor of the scene, centred in x and y; sizes in m. `species` and `rest` are
// further text of the scene.
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

// Small grains of 1 mm on a loose lattice, in a box that is 40 of them wide. One big grain low in the middle
// takes the place of those that it would touch.
constexpr double kSmall = 0.001, kApart = 1.1 * kSmall, kWide = 0.044;  // m

BenchBed sea(int particles, double big) {
    BenchBed bed = box("sea.toml", {kWide, kWide, 0.5},
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
                                   particles, kSmall, big),
                       "[drive]\nfrequency = 25\ng_level = 3\n");
    const int across = static_cast<int>(kWide / kApart);
    const Vec3 centre(0, 0, big / 2 + 5 * kApart);
    Random random(1, Stream::centres);
    bed.grains.reserve(particles);
    bed.grains.add(0, 1, centre, big / 2, 2500);
    for (int site = 0; static_cast<int>(bed.grains.size()) < particles; ++site) {
        const Vec3 corner(-kWide / 2, -kWide / 2, 0);
        const Vec3 shift = random.in_cube(0.03);
        const Vec3 at = corner + kApart * Vec3(site % across + (0.5 + shift.x()),
                                               site / across % across + (0.5 + shift.y()),
                                               site / (across * across) + (0.5 + shift.z()));
        if ((at - centre).norm() < (big + kSmall) / 2 * 1.01) continue;
        bed.grains.add(static_cast<std::int32_t>(bed.grains.size()), 0, at, kSmall / 2, 2500);
    }
    return bed;
}

// A twentieth of the space is solid. Elastic walls and nearly elastic grains keep it a gas.
BenchBed gas(int particles) {
    const double edge = kSmall * math::cbrt(particles * std::numbers::pi / 6 / 0.05);
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
                                   particles, kSmall),
                       "");
    const int across = static_cast<int>(std::ceil(math::cbrt(particles)));
    Random random(1, Stream::centres);
    bed.grains.reserve(particles);
    for (int site = 0; site < particles; ++site) {
        const Vec3 corner(-edge / 2, -edge / 2, 0);
        const Vec3 at = corner + edge / across *
                                     Vec3(site % across + 0.5, site / across % across + 0.5,
                                          site / (across * across) + 0.5);
        bed.grains.add(site, 0, at, kSmall / 2, 2500);
        bed.grains.motion.back().velocity = random.in_cube(0.5);
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
             [](int n) { return sea(n, 20 * kSmall); }},
            {"sea",
             "the same with one that is no larger: what the large one costs",
             sea_of,
             -20000,
             20000,
             20,
             {{"settled", 3000}, {"vibrated", 10000}},
             [](int n) { return sea(n, kSmall); }},
            {"gas", "a twentieth of the space solid, no gravity", 10000, 0, 2000, 0, {{"gas", 20000}}, gas}};
}

}  // namespace grainreel
