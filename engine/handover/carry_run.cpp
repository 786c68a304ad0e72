// What comes and goes, how the grains begin, what is kept, and how ranks share the room.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/handover/carry_parts.hpp"
#include "engine/plan/times.hpp"

namespace grainreel {

namespace {

constexpr std::int64_t most_dumps = 10'000'000;

std::vector<std::int64_t> trajectory_steps(const Plan& plan) {
    std::vector<std::int64_t> steps;
    const Rhythm rhythm(plan.trajectory_every, plan.trajectory_periods);
    for (std::int64_t step = rhythm.next(0, plan.clock);
         step <= plan.steps && step != Rhythm::kNever && static_cast<std::int64_t>(steps.size()) < most_dumps;
         step = rhythm.next(step + 1, plan.clock))
        steps.push_back(step);
    return steps;
}

void choose_dumps(const CarryRequest& request, CarriedScene& carried) {
    std::vector<std::int64_t>& dumps = carried.dumps;
    dumps = request.dumps.empty() ? trajectory_steps(carried.plan) : request.dumps;
    dumps.push_back(0);
    dumps.push_back(carried.plan.steps);
    std::sort(dumps.begin(), dumps.end());
    dumps.erase(std::unique(dumps.begin(), dumps.end()), dumps.end());
    std::erase_if(dumps, [&](std::int64_t step) { return step < 0 || step > carried.plan.steps; });
}

// s: the fall through a lattice as high as the grains need, at the drag's end speed, and the time to rest.
void choose_packing(const CarryRequest& request, CarriedScene& carried) {
    const Scene& scene = carried.scene;
    carried.packs = scene.start.packs() && scene.grains_at_start() > request.packs_above;
    if (!carried.packs) return;
    const double gravity = scene.gravity.norm();
    double largest = 0;
    for (const Species& one : scene.species) largest = std::max(largest, one.diameter.largest);
    // The drag of settling, which also ends the bouncing.
    carried.packing_drag = scene.start.settle_damping;
    const double end_speed = carried.packing_drag > 0 ? gravity / carried.packing_drag : 1e9;
    const double fall = carried.plan.bed_height;
    const double time =
        gravity > 0 ? fall / end_speed + std::sqrt(2 * fall / gravity) + 30 * std::sqrt(largest / gravity)
                    : 0;
    carried.packing_steps = static_cast<std::int64_t>(
        std::ceil(std::min(time, std::max(scene.start.settle_limit, 1e-3)) / carried.step));
    add_change(
        carried, scene.where("start"),
        fmt::format("the grains are packed there: they fall from a lattice for {:.3g} s, with our drag "
                    "of {} 1/s",
                    static_cast<double>(carried.packing_steps) * carried.step, carried.packing_drag),
        fmt::format("above {} grains our packing takes longer than theirs on many ranks (--pack-there "
                    "sets the number)",
                    request.packs_above));
    for (const CarriedPair& pair : carried.pairs)
        if (pair.law == CarriedLaw::hertz && carried.engine == PeerEngine::lammps) {
            add_refusal(
                carried, scene.where("contact.law"),
                "hertz with packing there: LAMMPS of 29 Sep 2021 changes a wall's damping at each further "
                "run; pack here (--pack-there above the number of grains)");
            break;
        }
}

void choose_grid(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    double smallest = INFINITY;
    for (const Species& one : scene.species) smallest = std::min(smallest, one.diameter.smallest);
    carried.skin = 0.2 * smallest;
    // Cut along z, one rank has nearly all grains.
    carried.grid = {0, 0, scene.gravity.z() != 0 ? 1 : 0};
    carried.balances = carried.ranks > 2 &&
                       (scene.container.shape != Container::Shape::box || scene.container.outlet.has_value());
}

void say_start(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (scene.start.keep_clock)
        add_refusal(carried, scene.where("start.keep_clock"),
                    "a run that goes on with its file's clock is not handed over; leave keep_clock out, or "
                    "`resume` it here");
    if (carried.packs || scene.grains_at_start() == 0) return;
    add_change(
        carried, scene.where("start"), "contacts begin there without their histories",
        "no file carries them: a bed at rest creeps by 13 um on average, 6 um downwards, where it would "
        "by 1.2 um with them");
}

void check_traffic(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (!scene.exits.empty() && carried.engine == PeerEngine::liggghts)
        add_refusal(
            carried, scene.where("exit[0]"),
            "exits of a box are not carried to LIGGGHTS; an outlet is, and --to lammps carries exits");
    for (std::size_t f = 0; f < scene.feeds.size(); ++f) {
        const std::string where = scene.where(fmt::format("feed[{}]", f));
        if (carried.engine == PeerEngine::lammps)
            add_refusal(
                carried, where,
                "LAMMPS keeps no rate of a feed (400 grains came in 0.24 s where 1 s was asked for); use "
                "--to liggghts");
        else if (scene.species[scene.feeds[f].species].diameter.kind != SizeSpread::Kind::fixed)
            add_change(carried, where, "a feed's spread of sizes becomes several sizes, each as frequent",
                       "LIGGGHTS inserts grains of given sizes alone");
    }
}

// Files of ours that a dump has not.
void say_output(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (scene.keeps_orientations())
        add_change(carried, scene.where("output.orientation"), "no orientations are kept",
                   "their dumps of spheres have none");
    if (scene.output.contacts)
        add_change(carried, scene.where("output.contacts"), "no contacts are kept",
                   "a dump has grains alone");
}

}  // namespace

void carry_run(const CarryRequest& request, CarriedScene& carried) {
    carried.step = carried.plan.clock.step;
    carried.last = carried.plan.steps;
    carried.opens = carried.plan.opens.value_or(0);
    choose_dumps(request, carried);
    choose_grid(carried);
    choose_packing(request, carried);
    for (const CarriedPair& pair : carried.pairs)
        if (pair.law == CarriedLaw::hertz && carried.engine == PeerEngine::lammps &&
            !carried.opened.empty() && carried.opens > 0) {
            add_refusal(
                carried, carried.scene.where("container.outlet.opens"),
                "hertz with an outlet that opens later: LAMMPS of 29 Sep 2021 changes a wall's damping "
                "at each further run");
            break;
        }
    say_start(carried);
    check_traffic(carried);
    say_output(carried);
}

}  // namespace grainreel
