// Measures how much the step loop saves when a scene lacks something, such as friction: the cost of a step on
// a lattice of grains, with and without it.
#include "engine/lab/chart/accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_world.hpp"

namespace grainreel {
namespace {

constexpr int kSide = 20;  // grains along an edge

PairPlan contact() {
    return latching_pair(bench_stiffness, 0.9, 0.5);
}

// A cubic lattice on a floor. Each grain has six contacts with friction, and the step is so short that the
// lists stay valid.
SmallWorld& build(SmallWorld& world) {
    world.add_floor();
    world.around.gravity = {0, 0, -9.81};
    const double apart = 2 * bench_radius * (1 - 1e-4);
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                world.add(apart * Vec3(x, y, z) + Vec3(0, 0, 0.9999 * bench_radius),
                          0.01 * Vec3(y % 2, z % 2, x % 2));
    return world;
}

// Time (ns of one thread) that one step takes, divided by the number of grains.
double cost(SmallWorld& world, std::int64_t steps) {
    const auto begin = std::chrono::steady_clock::now();
    world.run(steps);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    return taken.count() / (static_cast<double>(steps) * kSide * kSide * kSide);
}

// Two small worlds that are equal except for one thing that costs time: one has it and the other does not.
struct Saving {
    std::string name;
    std::function<void(SmallWorld&)> with, without;
};

void shake(SmallWorld& world) {
    Drive drive;
    drive.present = true;
    drive.amplitude = 1e-12;  // m; so small that the lattice stays as it is
    drive.frequency = 20;
    world.plan.clock.steps_per_period = 50000000;
    world.around.motion = DriveMotion(drive, world.plan.clock);
    world.plan.moving_walls = true;
    for (Face& face : world.around.faces) face.body.driven = true;
}

// Makes every second grain one of another species, with contacts of its own.
void mix(SmallWorld& world) {
    for (std::size_t i = 0; i < world.grains.size(); i += 2) world.grains.species[i] = 1;
    world.plan.grain.assign(4, contact());
    world.plan.wall.assign(2, contact());
    for (int kind : {1, 2, 3}) world.plan.grain[kind].loading_stiffness *= 1 + 0.1 * (kind == 3 ? 2 : 1);
}

std::function<void(SmallWorld&)> each_contact(const std::function<void(PairPlan&)>& change) {
    return [change](SmallWorld& world) {
        for (auto* kinds : {&world.plan.grain, &world.plan.wall})
            for (PairPlan& pair : *kinds) change(pair);
    };
}

std::vector<Saving> savings() {
    const auto nothing = [](SmallWorld&) {};
    return {
        {"friction and spin", nothing, each_contact([](PairPlan& p) {
             p.model.tangential = TangentialLaw::none;
             p.friction = 0;
         })},
        {"incremental slip instead of a linear spring", nothing,
         each_contact([](PairPlan& p) { p.model.tangential = TangentialLaw::linear_spring; })},
        {"corrections of contacts",
         each_contact([](PairPlan& p) { p.model.normal = NormalForce::walton_braun_corrected; }), nothing},
        {"restitution that falls with speed", each_contact([](PairPlan& p) {
             p.model.normal = NormalForce::walton_braun_speed;
             p.hardening = 1e4;
         }),
         nothing},
        {"resistance to rolling", each_contact([](PairPlan& p) {
             p.model.rolls = true;
             p.rolling_friction = 0.1;
         }),
         nothing},
        {"double precision of the laws", nothing,
         each_contact([](PairPlan& p) { p.model.precision = Precision::mixed; })},
        {"a second species", mix, nothing},
        {"moving walls", shake, nothing},
        {"gravity", nothing,
         [](SmallWorld& world) {
             world.around.gravity = {0, 0, 0};
         }},
    };
}

struct Measured {
    double with = 1e9, without = 1e9;  // ns for a step of a grain, the best of all rounds
    double low = 1e9, high = 0;        // smallest and largest ratio without / with, of all rounds
};

// The two are timed in turns, so that other work of the machine slows both alike.
Measured measure(const Saving& saving, int rounds) {
    SmallWorld with(contact(), 1e-9), without(contact(), 1e-9);
    saving.with(build(with)), saving.without(build(without));
    with.start(), without.start();
    constexpr std::int64_t steps = 100;
    cost(with, steps), cost(without, steps);
    Measured m;
    for (int round = 0; round < rounds; ++round) {
        const double a = cost(with, steps), b = cost(without, steps);
        m.with = std::min(m.with, a), m.without = std::min(m.without, b);
        m.low = std::min(m.low, b / a), m.high = std::max(m.high, b / a);
    }
    return m;
}

}  // namespace

bool run_savings(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    ResultTable table(request.folder / "savings.csv", "left_out,ns_with,ns_without,ratio,lowest,highest", 1);
    const std::vector<Saving> all = savings();
    ChartWork work(watcher, all.size());
    for (const Saving& saving : all) {
        if (!work.next(saving.name)) return false;
        if (table.has({saving.name})) continue;
        const Measured m = measure(saving, request.quick ? 5 : 25);
        table.add({saving.name, number(m.with), number(m.without), number(m.without / m.with), number(m.low),
                   number(m.high)});
    }
    return true;
}

std::string savings_drawing() {
    return R"(# Draws savings.csv: gnuplot savings.gp
set datafile separator ','
set key outside top center horizontal
set style fill solid 0.8
set grid x
set xrange [0:*]
set yrange [] reverse
set offsets 0, 0, 0.6, 0.6
set xlabel 'ns of one thread for a step of a grain with six contacts'
do for [form in "svg png"] {
    if (form eq "svg") { set terminal svg size 900,460 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1350,690 font 'DejaVu Sans,18' }
    set output 'savings.'.form
    plot 'savings.csv' every ::1 using 2:($0-0.18):(0):2:($0-0.36):($0):ytic(1) with boxxyerror lc rgb '#0072b2' title 'with', \
         '' every ::1 using 3:($0+0.18):(0):3:($0):($0+0.36) with boxxyerror lc rgb '#e69f00' title 'without'
}
)";
}

}  // namespace grainreel
