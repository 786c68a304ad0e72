#include "engine/handover/start_state.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/drive_schedule.hpp"
#include "engine/start/layers.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

// engine/handover/lattice.cpp
std::vector<Vec3> lattice_places(const CarriedScene& carried, std::size_t count, double largest);

namespace {

using Grain = StartState::Grain;

// Ours packs, and its last frame is the start.
bool packed_here(const CarriedScene& carried, int threads, const PackingWatcher& watcher, StartState& start) {
    Simulation run(carried.scene, carried.plan, threads);
    const PackingResult result = run.pack(watcher);
    start.stopped = !result.finished;
    start.settled = result.settled;
    if (start.stopped) return false;
    const Frame frame = run.frame();
    start.grains.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto species = static_cast<std::size_t>(frame.species[i]);
        start.grains.push_back({frame.id[i] + 1, frame.species[i] + 1, 2 * frame.radius[i],
                                carried.types[species].density, frame.position[i], frame.velocity[i],
                                frame.spin[i]});
    }
    return true;
}

// Our grains, the lowest of their layers at the lowest places.
void laid_out(const CarriedScene& carried, StartState& start) {
    const Grains drawn = place_in_layers(carried.scene);
    std::vector<std::size_t> order(drawn.size());
    double largest = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        order[i] = i;
        largest = std::max(largest, 2 * drawn.place[i].radius);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return drawn.place[a].position.z() < drawn.place[b].position.z();
    });
    const std::vector<Vec3> places = lattice_places(carried, drawn.size(), largest);
    start.grains.resize(drawn.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t i = order[k];
        start.grains[i] = {drawn.id[i] + 1,
                           drawn.species[i] + 1,
                           2 * drawn.place[i].radius,
                           carried.types[static_cast<std::size_t>(drawn.species[i])].density,
                           places[k],
                           Vec3(0, 0, 0),
                           Vec3(0, 0, 0)};
    }
    std::sort(start.grains.begin(), start.grains.end(),
              [](const Grain& a, const Grain& b) { return a.id < b.id; });
}

void add_glued(const CarriedScene& carried, StartState& start) {
    const GluedGrains glued = glue_grains(carried.scene, carried.faces);
    std::int64_t id = start.grains.empty() ? 0 : start.grains.back().id;
    for (std::size_t g = 0; g < glued.size(); ++g)
        start.grains.push_back({++id, static_cast<int>(carried.type_count()), 2 * glued.place[g].radius,
                                carried.types.back().density, glued.centre(g, carried.faces, Pose()),
                                Vec3(0, 0, 0), Vec3(0, 0, 0)});
}

// Free grains as the container sees them.
void into_frame(const CarriedScene& carried, std::size_t free_grains, StartState& start) {
    if (!carried.rides()) return;
    const Pose pose = WallMotion(carried.scene.drive, carried.plan.clock).at(carried.first);
    for (std::size_t i = 0; i < free_grains; ++i) {
        start.grains[i].position -= pose.offset;
        // Nothing moves yet where the deck packs first.
        if (!carried.packs) start.grains[i].velocity -= pose.velocity;
    }
}

void include(CarriedScene& carried, const Vec3& low, const Vec3& high) {
    carried.low = carried.low.cwiseMin(low);
    carried.high = carried.high.cwiseMax(high);
}

// A container that turns sweeps a ball about its axis.
void include_turn(CarriedScene& carried, const BodyTurn& turn) {
    double farthest = 0;
    const Vec3 low = carried.low, high = carried.high;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                      corner & 4 ? high.z() : low.z());
        farthest = std::max(farthest, (at - turn.through).norm());
    }
    const Vec3 all = Vec3::Constant(farthest);
    include(carried, turn.through - all, turn.through + all);
}

void set_box(CarriedScene& carried, const StartState& start) {
    const Scene& scene = carried.scene;
    const Container& c = scene.container;
    double largest = 0;
    for (const CarriedType& type : carried.types) largest = std::max(largest, type.largest);
    const double margin = 2 * largest;
    const double half_depth = c.shape == Container::Shape::cylinder ? c.half_width : c.depth / 2;
    carried.low = Vec3(-half_depth, -c.half_width, c.base());
    // Without a lid the walls go on upwards, and grains may fly.
    carried.high = Vec3(half_depth, c.half_width, c.lid ? c.height : 3 * c.height);
    for (const SceneMesh& mesh : scene.meshes) include(carried, mesh.low, mesh.high);
    if (c.outlet) include(carried, Vec3(0, 0, -c.outlet->exit_depth), carried.high);
    if (c.tray)
        include(carried, Vec3(0, -c.tray->half_width, -c.tray->depth),
                Vec3(0, c.tray->half_width, carried.high.z()));
    for (const Grain& grain : start.grains) {
        const Vec3 r = Vec3::Constant(grain.diameter / 2);
        include(carried, grain.position - r, grain.position + r);
    }
    for (const Feed& feed : scene.feeds) include(carried, feed.low, feed.high);
    if (c.turn) include_turn(carried, *c.turn);
    if (c.shape == Container::Shape::none) {  // nothing says how far they go
        const Vec3 size = carried.high - carried.low;
        include(carried, carried.low - size, carried.high + size);
    }
    Vec3 more = Vec3::Constant(margin);
    if (!carried.drive.empty() && !carried.rides())
        more += drive_peaks(scene.drive).offset * scene.drive.direction.cwiseAbs();
    include(carried, carried.low - more, carried.high + more);
    if (!carried.periodic) return;
    carried.low.x() = -c.depth / 2;
    carried.high.x() = c.depth / 2;
}

}  // namespace

StartState start_state(CarriedScene& carried, int threads, const PackingWatcher& watcher) {
    StartState start;
    if (carried.packs)
        laid_out(carried, start);
    else if (!packed_here(carried, threads, watcher, start))
        return start;
    const std::size_t free_grains = start.grains.size();
    if (!carried.plan.glued.empty()) add_glued(carried, start);
    into_frame(carried, free_grains, start);
    set_box(carried, start);
    return start;
}

}  // namespace grainreel
