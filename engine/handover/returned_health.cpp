#include "engine/handover/returned_health.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/health.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/run/import/import_measures.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

namespace {

// A sphere, or its image beyond the periodic side, in its cell of a grid. Cells are as wide as the largest
// sphere. A cell's number has 21 bits for each axis; what lies farther away is in the last cells, which loses
// no neighbour.
struct Entry {
    std::uint64_t cell;
    std::int32_t index;
    bool image;
    Vec3 position;  // m
    double radius;  // m
};

constexpr int kBits = 21;
constexpr double kMostCells = (1 << kBits) - 3;
constexpr std::uint64_t kRow = std::uint64_t{1} << kBits, kLayer = kRow << kBits;

std::uint64_t cell_at(const Vec3& place, const Vec3& low, double width) {
    std::array<std::uint64_t, 3> n{};
    for (int k = 0; k < 3; ++k)
        n[k] = 1 + static_cast<std::uint64_t>(std::clamp((place[k] - low[k]) / width, 0.0, kMostCells));
    return n[0] + kRow * n[1] + kLayer * n[2];
}

std::vector<Entry> entries_of(const std::vector<Place>& places, double period) {
    double largest = 0;
    Vec3 low = places.front().position;
    for (const Place& place : places) {
        largest = std::max(largest, place.radius);
        low = low.cwiseMin(place.position);
    }
    if (period > 0) low.x() = 0;
    const double width = 2 * largest * (1 + 1e-12);
    std::vector<Entry> all;
    all.reserve(places.size());
    const auto add = [&](std::size_t i, const Vec3& at, bool image) {
        all.push_back({cell_at(at, low, width), static_cast<std::int32_t>(i), image, at, places[i].radius});
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vec3 at = places[i].position;
        if (period > 0) at.x() -= period * std::floor(at.x() / period);
        add(i, at, false);
        if (period > 0 && at.x() < width) add(i, at + Vec3(period, 0, 0), true);
    }
    std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.index < b.index;
    });
    return all;
}

}  // namespace

void for_overlapping(const std::vector<Place>& places, double period,
                     const std::function<void(std::int32_t, std::int32_t, double)>& see) {
    if (places.empty()) return;
    const std::vector<Entry> all = entries_of(places, period);
    const auto look = [&](const Entry& one, const Entry& other) {
        if ((one.image && other.image) || one.index == other.index) return;
        const double reach = one.radius + other.radius;
        const double squared = (one.position - other.position).squaredNorm();
        if (squared < reach * reach) see(one.index, other.index, reach - std::sqrt(squared));
    };
    // The cells behind this one: those of the next row and of three rows in the next layer. begin[r] is the
    // first entry of such a row. It only moves forward, because entries are sorted by cell.
    constexpr std::array<std::uint64_t, 4> rows{kRow, kLayer - kRow, kLayer, kLayer + kRow};
    std::array<std::size_t, 4> begin{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size() && all[j].cell <= all[i].cell + 1; ++j)
            look(all[i], all[j]);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const std::uint64_t middle = all[i].cell + rows[r];
            while (begin[r] < all.size() && all[begin[r]].cell < middle - 1) ++begin[r];
            for (std::size_t j = begin[r]; j < all.size() && all[j].cell <= middle + 1; ++j)
                look(all[i], all[j]);
        }
    }
}

namespace {

// What is known of a contact. A large bed has millions of them, and a ContactView takes several times as much
// memory.
struct Seen {
    std::int32_t first, second;      // as in ContactView
    bool glued;                      // second is a grain that is glued to this face
    double overlap, smaller_radius;  // m
};

ContactView view_of(const Seen& seen) {
    ContactView view{};
    view.first = seen.first;
    view.second = seen.second;
    view.glued = view.triangle = -1;
    view.overlap = seen.overlap;
    view.smaller_radius = seen.smaller_radius;
    return view;
}

// Energy and momentum of a frame, for the comparison with the next one.
struct Account {
    std::int64_t step = 0;
    double time = 0;      // s
    double kinetic = 0;   // J, with spin
    double stored = 0;    // J, in normal springs as if all were loading; never less than they give back
    double momentum = 0;  // kg m/s, of all grains without regard to direction
};

// m/s, the largest speed of walls beside that of the drive.
double own_speed(const Surroundings& around, const Plan& plan) {
    double fastest = plan.wall_speed;
    for (const Face& face : around.faces) fastest = std::max(fastest, face.body.velocity.norm());
    for (const MeshWall& mesh : around.meshes) fastest = std::max(fastest, mesh.body.velocity.norm());
    return fastest;
}

constexpr double kSlack = 2;  // factor on what walls can give: the bound is one for a single rigid body
constexpr double kShareOfMotion = 0.05;  // share of the energy, as in our own runs

}  // namespace

struct ReturnedHealth::Impl {
    Impl(const Scene& scene_in, const Plan& plan_in)
        : scene(scene_in),
          plan(plan_in),
          limits(health_limits(scene, plan)),
          around(make_surroundings(scene, plan)),
          peaks(drive_peaks(scene.drive)) {}

    void find_contacts(const Grains& grains, std::int64_t step);
    void find_walls(const Grains& grains, const DrivePose& pose, std::int32_t grain);
    double stored_in(const Grains& grains) const;
    const PairPlan& pair_of(const Grains& grains, const Seen& contact) const;
    Account account_of(const Grains& grains, const State& frame) const;
    void check_energy(const Grains& grains, const Account& now, std::int64_t step) const;
    double fallen(const Grains& grains, double& mass, double& lift) const;

    const Scene& scene;
    const Plan& plan;
    const HealthLimits limits;
    Surroundings around;
    const DrivePeaks peaks;
    bool opened = false;
    std::vector<Seen> contacts;
    Grains before;  // the grains of the frame before, by rising id
    Account then;
    DeepestContact deepest;  // of all frames
};

// Finds the contacts with faces and meshes.
void ReturnedHealth::Impl::find_walls(const Grains& grains, const DrivePose& pose, std::int32_t grain) {
    const Place& place = grains.place[grain];
    const auto faces = static_cast<std::int32_t>(around.faces.size());
    for (std::int32_t f = 0; f < faces; ++f) {
        const double overlap = place.radius - distance_at(around.faces[f], pose, place.position).distance;
        if (overlap > 0) contacts.push_back({grain, -1 - f, false, overlap, place.radius});
    }
    for (std::size_t m = 0; m < around.meshes.size(); ++m) {
        const MeshWall& mesh = around.meshes[m];
        const Vec3 at_rest = mesh.body.at(pose).at_rest(place.position);
        const auto nearest = mesh.surface->nearest(at_rest, place.radius);
        if (!nearest) continue;
        const double overlap = place.radius - std::sqrt(nearest->point.squared);
        contacts.push_back({grain, -1 - faces - static_cast<std::int32_t>(m), false, overlap, place.radius});
    }
}

void ReturnedHealth::Impl::find_contacts(const Grains& grains, std::int64_t step) {
    contacts.clear();
    const DrivePose pose = around.motion.at(step);
    std::vector<Place> bodies(grains.place.begin(), grains.place.end());
    for (std::size_t g = 0; g < around.glued.size(); ++g)
        bodies.push_back({around.glued.centre(g, around.faces, pose), around.glued.place[g].radius});
    const auto free = static_cast<std::int32_t>(grains.size());
    for_overlapping(bodies, around.period, [&](std::int32_t a, std::int32_t b, double overlap) {
        if (a > b) std::swap(a, b);
        if (a >= free) return;  // two glued grains
        const double smaller = std::min(bodies[a].radius, bodies[static_cast<std::size_t>(b)].radius);
        if (b < free)
            contacts.push_back({a, b, false, overlap, smaller});
        else
            contacts.push_back({a, -1 - around.glued.face[b - free], true, overlap, smaller});
    });
    for (std::int32_t i = 0; i < free; ++i) find_walls(grains, pose, i);
}

const PairPlan& ReturnedHealth::Impl::pair_of(const Grains& grains, const Seen& contact) const {
    const auto species = static_cast<std::size_t>(grains.species[contact.first]);
    if (contact.second >= 0)
        return plan.between(species, static_cast<std::size_t>(grains.species[contact.second]));
    const std::size_t wall = static_cast<std::size_t>(-1 - contact.second);
    if (wall >= around.faces.size()) return plan.at_mesh(wall - around.faces.size(), species);
    return contact.glued ? plan.glued[species] : plan.wall[species];
}

double ReturnedHealth::Impl::stored_in(const Grains& grains) const {
    double sum = 0;
    for (const Seen& contact : contacts)
        sum += 0.5 * pair_of(grains, contact).loading_stiffness * contact.overlap * contact.overlap;
    return sum;
}

Account ReturnedHealth::Impl::account_of(const Grains& grains, const State& frame) const {
    Account now{.step = frame.step, .time = frame.time, .stored = stored_in(grains)};
    for (std::size_t i = 0; i < grains.size(); ++i)
        now.momentum += grains.mass(i) * grains.motion[i].velocity.norm();
    const Kinetic kinetic = kinetic_energy(grains);
    now.kinetic = kinetic.translation + kinetic.rotation;
    return now;
}

// The energy (J) that grains got from gravity since the frame before. For a grain that has come since then,
// its kinetic energy is counted instead. mass: kg, of all grains; lift: J, what it takes to raise each grain
// by its radius.
double ReturnedHealth::Impl::fallen(const Grains& grains, double& mass, double& lift) const {
    double energy = 0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        mass += grains.mass(i);
        lift += grains.mass(i) * around.gravity.norm() * grains.place[i].radius;
        while (k < before.size() && before.id[k] < grains.id[i]) ++k;
        if (k < before.size() && before.id[k] == grains.id[i])
            energy +=
                grains.mass(i) * around.gravity.dot(grains.place[i].position - before.place[k].position);
        else
            energy += 0.5 * grains.mass(i) * grains.motion[i].velocity.squaredNorm() +
                      0.5 * grains.inertia(i) * grains.motion[i].spin.squaredNorm();
    }
    return energy;
}

// Walls that move as one rigid body with velocity v(t) do the work
//     int F v dt = [p v] - int p a dt - M g int v dt,  with F = dp/dt - M g,
// where p is the momentum of all grains and a = dv/dt. So it is at most v (p0 + p1) + (a p + M g v) T, with
// the largest v and a of any wall. A wall that stops and starts by itself gives at most v p more.
void ReturnedHealth::Impl::check_energy(const Grains& grains, const Account& now, std::int64_t step) const {
    if (before.size() == 0 || grains.size() == 0) return;
    // Where gravity points through a periodic side, grains fall without end, and their places do not tell how
    // far.
    if (around.period > 0 && around.gravity.x() != 0) return;
    double mass = 0, lift = 0;
    const double got = fallen(grains, mass, lift);
    const double own = own_speed(around, plan), speed = peaks.speed + own, passed = now.time - then.time;
    const double momentum = std::max(then.momentum, now.momentum);
    const double by_walls =
        kSlack * (speed * (then.momentum + now.momentum) + (peaks.acceleration * passed + own) * momentum +
                  mass * around.gravity.norm() * speed * passed);
    const double gained = now.kinetic + now.stored - then.kinetic - then.stored - got;
    if (!(gained > by_walls + kShareOfMotion * (now.kinetic + then.kinetic + then.stored) + lift)) return;
    throw RunError(energy_gained_text(
        limits, grains, step, gained - by_walls,
        fmt::format("walls can have given {:.3g} J at most since step {}", by_walls, then.step)));
}

ReturnedHealth::ReturnedHealth(const Scene& scene, const Plan& plan)
    : impl_(std::make_unique<Impl>(scene, plan)) {}

ReturnedHealth::~ReturnedHealth() = default;

double ReturnedHealth::look(const State& frame) {
    Impl& m = *impl_;
    if (!m.opened && m.plan.opens && frame.step >= *m.plan.opens) {
        open_outlet(m.scene, m.around);
        m.opened = true;
    }
    Grains grains = grains_of(frame, m.scene);
    m.find_contacts(grains, frame.step);
    const auto show = [&](const auto& see) {
        for (const Seen& contact : m.contacts) see(view_of(contact));
    };
    DeepestContact now_deepest = check_state(m.limits, m.around, grains, show, frame.step);
    const double largest = now_deepest.share;
    if (largest > m.deepest.share) m.deepest = std::move(now_deepest);
    const Account now = m.account_of(grains, frame);
    m.check_energy(grains, now, frame.step);
    m.before = std::move(grains);
    m.then = now;
    return largest;
}

const DeepestContact& ReturnedHealth::deepest() const {
    return impl_->deepest;
}

std::string ReturnedHealth::overlap_text() const {
    return grainreel::overlap_text(impl_->limits, impl_->deepest);
}

}  // namespace grainreel
