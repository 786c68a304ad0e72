#include "engine/handover/carry.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/plan/times.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

const char* name_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "LAMMPS" : "LIGGGHTS";
}

const char* key_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "lammps" : "liggghts";
}

const char* version_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "29 Sep 2021" : "3.8.0";
}

void add_change(CarriedScene& carried, const std::string& where, const std::string& what,
                const std::string& why) {
    carried.changes.push_back({where, what, why});
}

void add_refusal(CarriedScene& carried, const std::string& where, const std::string& what) {
    carried.refusals.push_back({where, what, {}});
}

CarriedScene carry(const Scene& scene, const Plan& plan, const CarryRequest& request) {
    CarriedScene carried;
    carried.engine = request.engine;
    carried.ranks = request.ranks;
    carried.engine_option = request.engine_option;
    carried.pack_option = request.pack_option;
    carried.scene = with_choices(scene, plan);
    carry_laws(request, plan, carried);
    if (!carried.refusals.empty()) {
        // The rest is checked nevertheless, so that all refusals come at once.
        carried.plan = plan;
        carry_walls(carried);
        carry_run(request, carried);
        return carried;
    }
    carried.plan = make_plan(carried.scene);
    carry_contacts(request, carried);
    carry_walls(carried);
    carry_run(request, carried);
    return carried;
}

namespace {

std::string refusal_text(const CarryNote& note) {
    return note.where + (note.where.empty() ? "" : ": ") + note.what;
}

}  // namespace

void throw_refusals(const CarriedScene& carried, const std::function<void(const std::string&)>& tell) {
    if (carried.refusals.empty()) return;
    for (std::size_t i = 0; i + 1 < carried.refusals.size(); ++i) tell(refusal_text(carried.refusals[i]));
    throw UserError(refusal_text(carried.refusals.back()));
}

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

// Decides whether the other engine packs the grains, with which drag and for how long: the time of the fall
// from the lattice, and the time to come to rest.
void choose_packing(const CarryRequest& request, CarriedScene& carried) {
    const Scene& scene = carried.scene;
    carried.packs = scene.start.packs() && scene.grains_at_start() > request.packs_above;
    if (!carried.packs) return;
    const double gravity = scene.gravity.norm();
    double largest = 0;
    for (const Species& one : scene.species) largest = std::max(largest, one.diameter.largest);
    // The same drag as in settling. It also stops grains from bouncing.
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
        fmt::format("above {} grains our packing takes longer than theirs on many ranks ({} sets the number)",
                    request.packs_above, carried.pack_option));
    for (const CarriedPair& pair : carried.pairs)
        if (pair.law == CarriedLaw::hertz && carried.engine == PeerEngine::lammps) {
            add_refusal(
                carried, scene.where("contact.law"),
                fmt::format(
                    "hertz with packing there: LAMMPS of 29 Sep 2021 changes a wall's damping at each "
                    "further run; pack here ({} above the number of grains)",
                    carried.pack_option));
            break;
        }
}

void choose_grid(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    double smallest = INFINITY;
    for (const Species& one : scene.species) smallest = std::min(smallest, one.diameter.smallest);
    carried.skin = 0.2 * smallest;
    // If the box were cut along z, one rank would have nearly all grains.
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
        "no file carries them, so a bed at rest creeps a little: grains of a bed on which we measured it "
        "crept "
        "by 13 um on average, 6 um downwards, and by 1.2 um with histories; yours may creep otherwise");
}

void check_traffic(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (!scene.exits.empty() && carried.engine == PeerEngine::liggghts)
        add_refusal(
            carried, scene.where("exit[0]"),
            fmt::format(
                "exits of a box are not carried to LIGGGHTS; an outlet is, and {} lammps carries exits",
                carried.engine_option));
    for (std::size_t f = 0; f < scene.feeds.size(); ++f) {
        const std::string where = scene.where(fmt::format("feed[{}]", f));
        if (carried.engine == PeerEngine::lammps)
            add_refusal(
                carried, where,
                fmt::format("LAMMPS keeps no rate of a feed (400 grains came in 0.24 s where 1 s was asked "
                            "for); use {} liggghts",
                            carried.engine_option));
        else if (scene.species[scene.feeds[f].species].diameter.kind != SizeSpread::Kind::fixed)
            add_change(carried, where, "a feed's spread of sizes becomes several sizes, each as frequent",
                       "LIGGGHTS inserts grains of given sizes alone");
    }
}

// Lists our files that cannot be made from a dump.
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

namespace {

bool is_driven(const Scene& scene) {
    return scene.drive.present && scene.drive.largest_amplitude() > 0;
}

// Why the run cannot be in the container's frame: what it is that does not move with the container. Empty
// where there is no such thing.
std::string stays_behind(const Scene& scene) {
    if (scene.drive.moves == Drive::Moves::floor) return "the floor alone moves";
    if (scene.container.turn) return "the container turns";
    if (scene.container.outlet) return "grains that have left stay behind";
    if (!scene.exits.empty()) return "exits stand still";
    if (!scene.feeds.empty()) return "the box of a feed stands still";
    for (const ScenePlane& wall : scene.walls)
        if (!wall.moves || !wall.velocity.isZero(0)) return "the wall " + wall.name + " moves otherwise";
    for (const SceneMesh& mesh : scene.meshes)
        if (!mesh.driven && mesh.name != scene.container.mesh)
            return "the mesh " + mesh.name + " moves otherwise";
    if (scene.container.shape == Container::Shape::none && scene.walls.empty())
        return "there is no container";
    return {};
}

void check_meshes(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        const std::string where = scene.where(fmt::format("mesh[{}]", m));
        if (carried.engine == PeerEngine::lammps)
            add_refusal(carried, where,
                        fmt::format("mesh {}: LAMMPS of {} has no walls of triangles; use {} liggghts",
                                    mesh.name, version_of(carried.engine), carried.engine_option));
        else if (!mesh.path_file.empty())
            add_refusal(carried, where,
                        fmt::format("mesh {}: a motion from a file is not carried; a turn, a steady velocity "
                                    "and the drive are",
                                    mesh.name));
        carried.meshes.push_back({m, m + 1});
    }
}

void check_outlet(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    if (!scene.container.outlet || carried.engine != PeerEngine::lammps) return;
    const std::string where = scene.where("container.outlet");
    if (scene.container.outlet->shape == Outlet::Shape::hole ||
        scene.container.shape == Container::Shape::cylinder)
        add_refusal(
            carried, where,
            fmt::format(
                "LAMMPS has no region for a floor with a round hole or below a cylinder; use {} liggghts",
                carried.engine_option));
    if (scene.container.turn)
        add_refusal(carried, where, "an outlet of a container that turns is not carried");
    if (scene.container.tray)
        add_refusal(carried, scene.where("container.tray"),
                    fmt::format("a tray is not carried to LAMMPS; use {} liggghts, or leave it out",
                                carried.engine_option));
}

}  // namespace

void carry_walls(CarriedScene& carried) {
    const Scene& scene = carried.scene;
    carried.faces = faces_of(scene);
    carried.turns.resize(carried.faces.size());
    for (std::size_t f = 0; f < carried.faces.size(); ++f)
        if (carried.faces[f].body.turn) carried.turns[f] = turn_formula(*carried.faces[f].body.turn);
    if (scene.container.outlet) {
        carried.opened = carried.faces;
        open_outlet(scene.container, carried.opened);
    }
    carried.drive = drive_formula(scene.drive);
    carried.periodic = period_of_depth(scene.container) > 0;
    if (is_driven(scene)) {
        const std::string reason = stays_behind(scene);
        carried.frame = reason.empty() ? ReferenceFrame::container : ReferenceFrame::lab;
        if (!reason.empty() && scene.container.wall_grains)
            add_refusal(
                carried, scene.where("container.wall_grains"),
                fmt::format("glued grains cannot move there, and the run cannot be in the container's "
                            "frame: {}",
                            reason));
    }
    check_meshes(carried);
    check_outlet(carried);
}

}  // namespace grainreel
