#include "engine/handover/start_state.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/random.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/start/layers.hpp"
#include "engine/state/drive_motion.hpp"
#include "engine/state/glued_grains.hpp"

namespace grainreel {

namespace {

// Spacings of the lattice that are tried, the loosest first, divided by the largest diameter. Grains are
// moved at random within the room that is left.
constexpr double kSpacings[] = {1.25, 1.15, 1.08, 1.02};

struct RoomOfLattice {
    explicit RoomOfLattice(const CarriedScene& scene) : carried(scene), space(scene.scene) {
        const Container& c = scene.scene.container;
        const double depth = c.shape == Container::Shape::cylinder ? 2 * c.half_width : c.depth;
        low = Vec3(-depth / 2, -c.half_width, c.base());
        high = Vec3(depth / 2, c.half_width, c.lid ? c.height : 100 * c.height);
        if (scene.scene.start.region) {
            low = scene.scene.start.region->low;
            high = scene.scene.start.region->high;
        }
        glued = scene.plan.glued.empty() ? 0 : scene.types.back().largest / 2;
    }
    bool holds(const Vec3& place, double margin) const {
        if (!carried.scene.meshes.empty()) return space.holds(place, margin);
        for (const Face& face : carried.faces) {
            const double from_glued = face.body.number == kTrayBody ? 0 : glued;
            if (distance_at(face, DrivePose(), place).distance < margin + from_glued) return false;
        }
        return true;
    }
    const CarriedScene& carried;
    FreeSpace space;
    Vec3 low, high;
    double glued = 0;  // m, how far glued grains reach inwards
};

bool fill(const RoomOfLattice& room, double spacing, double jitter, double radius, std::size_t count,
          std::uint64_t seed, std::vector<Vec3>& places) {
    Random random(seed, Stream::centres, {1});
    const double margin = radius + jitter;
    const Vec3 size = room.high - room.low;
    // Across a periodic depth the lattice must be periodic too.
    const double along =
        std::max(1.0, std::floor((size.x() - (room.carried.periodic ? 0 : 2 * margin)) / spacing +
                                 (room.carried.periodic ? 0 : 1)));
    const double dx = room.carried.periodic ? size.x() / along : spacing;
    const double x0 = room.carried.periodic ? room.low.x() + dx / 2 : -(along - 1) * dx / 2;
    places.clear();
    for (double z = room.low.z() + margin; z <= room.high.z() - margin; z += spacing)
        for (double y = room.low.y() + margin; y <= room.high.y() - margin; y += spacing)
            for (double i = 0; i < along; ++i) {
                const Vec3 place(x0 + i * dx, y, z);
                if (!room.holds(place, margin)) continue;
                places.push_back(place + random.in_cube(jitter));
                if (places.size() == count) return true;
            }
    return false;
}

// Places for grains that another engine packs. They are apart from each other and from all walls, from the
// bottom up. count: of grains. largest: m, diameter of the largest grain.
std::vector<Vec3> lattice_places(const CarriedScene& carried, std::size_t count, double largest) {
    const RoomOfLattice room(carried);
    std::vector<Vec3> places;
    for (const double spacing : kSpacings)
        if (fill(room, spacing * largest, 0.49 * (spacing - 1) * largest, largest / 2, count,
                 carried.scene.run.seed, places))
            return places;
    throw UserError(
        "{}: {} grains do not fit the container without touching, as they must where the other engine packs; "
        "let ours pack ({} above {}), or take the lid off",
        carried.scene.where("start"), count, carried.pack_option, count);
}

using Grain = StartState::Grain;

// Packs with our engine. Grains that lie in an exit are handed over too, because the other engine lets them
// leave.
bool packed_here(const CarriedScene& carried, int threads, const PackingWatcher& watcher, StartState& start) {
    SimulatedBed run(carried.scene, carried.plan, threads);
    State frame;
    const PackingResult result = run.pack(watcher, [&](const PackingResult&) { frame = run.frame(); });
    start.stopped = !result.finished;
    start.settled = result.settled;
    if (start.stopped) return false;
    start.grains.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto species = static_cast<std::size_t>(frame.species[i]);
        start.grains.push_back({frame.id[i] + 1, frame.species[i] + 1, 2 * frame.radius[i],
                                carried.types[species].density, frame.position[i], frame.velocity[i],
                                frame.spin[i]});
    }
    return true;
}

// Puts our grains on the lattice. The lowest grains get the lowest places.
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
        start.grains[i] = {.id = drawn.id[i] + 1,
                           .type = drawn.species[i] + 1,
                           .diameter = 2 * drawn.place[i].radius,
                           .density = carried.types[drawn.species[i]].density,
                           .position = places[k]};
    }
    std::sort(start.grains.begin(), start.grains.end(),
              [](const Grain& a, const Grain& b) { return a.id < b.id; });
}

void add_glued(const CarriedScene& carried, StartState& start) {
    const GluedGrains glued = glue_grains(carried.scene, carried.faces);
    std::int64_t id = start.grains.empty() ? 0 : start.grains.back().id;
    for (std::size_t g = 0; g < glued.size(); ++g)
        start.grains.push_back({.id = ++id,
                                .type = static_cast<int>(carried.type_count()),
                                .diameter = 2 * glued.place[g].radius,
                                .density = carried.types.back().density,
                                .position = glued.centre(g, carried.faces, DrivePose())});
}

// Changes places and velocities of free grains to those relative to the container.
void into_frame(const CarriedScene& carried, std::size_t free_grains, StartState& start) {
    if (!carried.rides()) return;
    const DrivePose pose = DriveMotion(carried.scene.drive, carried.plan.clock).at(carried.first);
    for (std::size_t i = 0; i < free_grains; ++i) {
        start.grains[i].position -= pose.offset;
        // If the deck packs first, nothing moves yet.
        if (!carried.packs) start.grains[i].velocity -= pose.velocity;
    }
}

void include(CarriedScene& carried, const Vec3& low, const Vec3& high) {
    carried.low = carried.low.cwiseMin(low);
    carried.high = carried.high.cwiseMax(high);
}

// The box that holds a turning container at all times.
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
    // Without a lid the walls continue upwards, and grains may fly.
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
    if (c.shape == Container::Shape::none) {  // the scene does not say how far grains go
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

namespace {

constexpr std::size_t kFlushAt = std::size_t{1} << 20;  // bytes

}  // namespace

void write_data_file(const std::filesystem::path& path, const CarriedScene& carried, const StartState& start,
                     std::size_t types) {
    TextFile file(path);
    fmt::memory_buffer text;
    const auto flush = [&](bool all) {
        if (!all && text.size() < kFlushAt) return;
        file.write({text.data(), text.size()});
        text.clear();
    };
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "handed over by grainreel; units si\n\n{} atoms\n{} atom types\n\n",
                   start.grains.size(), types);
    const char* names[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    for (int axis = 0; axis < 3; ++axis)
        fmt::format_to(out, "{} {} {}\n", carried.low[axis], carried.high[axis], names[axis]);
    fmt::format_to(out, "\nAtoms\n\n");
    for (const StartState::Grain& g : start.grains) {
        double x = g.position.x();
        if (carried.periodic) {  // read_data needs them inside the box
            const double depth = carried.high.x() - carried.low.x();
            x -= std::floor((x - carried.low.x()) / depth) * depth;
        }
        fmt::format_to(out, "{} {} {} {} {} {} {}\n", g.id, g.type, g.diameter, g.density, x, g.position.y(),
                       g.position.z());
        flush(false);
    }
    fmt::format_to(out, "\nVelocities\n\n");
    for (const StartState::Grain& g : start.grains) {
        fmt::format_to(out, "{} {} {} {} {} {} {}\n", g.id, g.velocity.x(), g.velocity.y(), g.velocity.z(),
                       g.spin.x(), g.spin.y(), g.spin.z());
        flush(false);
    }
    flush(true);
}

}  // namespace grainreel
