#include "engine/run/simulation.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/observers.hpp"
#include "engine/measure/segregation.hpp"
#include "engine/run/health.hpp"
#include "engine/run/surroundings.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/settle.hpp"
#include "engine/start/start_file.hpp"
#include "engine/state/wall_motion.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

double solid_fraction(const Container& container, const Grains& grains) {
    std::vector<double> heights;
    for (const Place& p : grains.place) heights.push_back(p.position.z());
    if (container.shape == Container::Shape::none) return 0;
    const double top = std::clamp(bed_height(heights), 0.0, container.height);
    double solid = 0;
    for (const Place& p : grains.place) {
        if (p.position.z() <= top) solid += 4.0 / 3.0 * std::numbers::pi * std::pow(p.radius, 3);
    }
    return top > 0 ? solid / container.volume_below(top) : 0;
}

}  // namespace

struct Simulation::Impl {
    Impl(const Scene& s, const Plan& p, int threads)
        : scene(s),
          plan(p),
          team(threads > 0 ? threads : usable_processors()),
          around(make_surroundings(s, p)),
          bodies(bodies_of(s.drive, s.walls)),
          limits(health_limits(s, p)) {
        for (const Species& one : scene.species) species_names.push_back(one.name);
        if (scene.start.method != Start::Method::layers) take_grains();
    }

    Scene scene;
    Plan plan;
    Team team;
    Surroundings around;
    std::vector<Body> bodies;
    Grains grains;
    std::unique_ptr<StepLoop> loop;
    std::int64_t step = 0;
    double start_energy = 0;
    HealthLimits limits;
    EnergyWatch energy_watch;
    std::int64_t next_look = 0;  // step

    bool continued = false;  // goes on where the file stopped
    bool opened = false;     // the container's outlet

    std::vector<std::string> species_names;
    std::unique_ptr<Observers> observers;  // of all columns; made when they are first wanted

    void make_loop() { loop = std::make_unique<StepLoop>(plan, around, grains, team); }
    void take_grains();
    void go_on();
    void set_orientations();
    bool pack_layers(const PackingWatcher& watcher, PackingProgress& progress);
    void begin_drive();
    void open_when_due();
    void look_at_health();
    Measures look(Observers& by) const;
};

void check_start(const Scene& scene, const Plan& plan) {
    if (scene.start.method != Start::Method::layers) Simulation(scene, plan, 1);
}

Simulation::Simulation(const Scene& scene, const Plan& plan, int threads)
    : impl_(std::make_unique<Impl>(scene, plan, threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

// Those of a file or a list, where they are.
void Simulation::Impl::take_grains() {
    const bool from_checkpoint = scene.start.method == Start::Method::file && is_checkpoint(scene.start.file);
    if (from_checkpoint && scene.start.keep_clock) return go_on();
    grains = scene.start.method == Start::Method::grains ? listed_grains(scene)
             : from_checkpoint                           ? grains_from_checkpoint(scene)
                                                         : grains_from_table(scene);
    check_grains_possible(scene, grains);
    check_grains_numbered(scene, grains);
    check_grains_match(scene, grains);
    check_grains_fit(scene, around.faces, grains);
    set_orientations();
    make_loop();
    loop->restart();
    check_grains_clear(scene, around.faces, grains, *loop);
}

void Simulation::Impl::go_on() {
    make_loop();
    const CheckpointHeader header = continue_from_checkpoint(scene, plan, grains, *loop);
    set_orientations();
    step = header.step;
    start_energy = header.start_energy;
    continued = true;
    opened = plan.opens && step >= *plan.opens;
    if (opened) open_outlet(scene, around);
    if (step >= plan.steps)
        throw UserError(
            fmt::format("{}: the start is at step {} already and the run ends at step {}; raise run.duration",
                        scene.where("run.duration"), step, plan.steps));
}

// They decide nothing: a run may begin or cease to keep them when it goes on.
void Simulation::Impl::set_orientations() {
    if (!scene.keeps_orientations())
        grains.orientation.clear();
    else if (grains.orientation.empty())
        grains.orientation.assign(grains.size(), Quaternion::Identity());
}

bool Simulation::Impl::pack_layers(const PackingWatcher& watcher, PackingProgress& progress) {
    grains = place_in_layers(scene);
    set_orientations();
    const GrowthReport growth =
        grow_radii(scene, plan, around, grains, team, [&](double done, std::int64_t steps) {
            progress.done = done;
            progress.steps = steps;
            return watcher(progress);
        });
    make_loop();
    loop->restart();
    return growth.finished;
}

// Work and balance count from here; the forces belong to the state, so that the first half kick is right.
void Simulation::Impl::begin_drive() {
    std::fill(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
    loop->begin_account();
    start_energy = total_energy(around, grains, *loop, 0);
    step = 0;
    open_when_due();
}

void Simulation::Impl::open_when_due() {
    if (opened || !plan.opens || step < *plan.opens) return;
    loop->open_faces([&] { open_outlet(scene, around); }, step);
    opened = true;
}

PackingResult Simulation::pack() {
    return pack([](const PackingProgress&) { return true; });
}

PackingResult Simulation::pack(const PackingWatcher& watcher) {
    Impl& m = *impl_;
    PackingResult result;
    PackingProgress progress;
    progress.stage = PackingProgress::Stage::growing;
    if (m.continued) return result;
    if (m.scene.start.method == Start::Method::layers) result.finished = m.pack_layers(watcher, progress);
    if (result.finished) {
        progress.stage = PackingProgress::Stage::settling;
        const auto watch = [&](double done, std::int64_t steps) {
            progress.done = done;
            progress.steps = steps;
            return watcher(progress);
        };
        const SettleReport settled = settle(m.scene, m.plan, m.around, m.grains, *m.loop, watch);
        result.finished = settled.finished;
        result.settled = settled.settled;
        result.settle_time = static_cast<double>(settled.steps) * m.plan.clock.step;
        result.kinetic_per_grain = settled.kinetic_per_grain;
    }
    result.solid_fraction = solid_fraction(m.scene.container, m.grains);
    m.begin_drive();
    return result;
}

void Simulation::Impl::look_at_health() {
    check_state(limits, around, grains, *loop, step);
    // Round-off and a law's own closed loops must not stop a bed at rest: a hundredth of its weight over a
    // radius.
    double allowance = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        allowance += 0.01 * grains.mass(i) * around.gravity.norm() * grains.place[i].radius;
    }
    const Traffic& traffic = loop->traffic();
    energy_watch.check(total_energy(around, grains, *loop, step) + traffic.energy_out - traffic.energy_in,
                       wall_work(grains) + traffic.work_out, allowance, limits, grains, step);
    next_look = step + steps_to_next_look(limits, around, grains, step);
}

void Simulation::advance(std::int64_t target) {
    Impl& m = *impl_;
    while (m.step < target) {
        if (m.next_look <= m.step) m.look_at_health();  // the first: where all begins
        std::int64_t until = std::min(target, m.next_look);
        if (!m.opened && m.plan.opens) until = std::min(until, *m.plan.opens);
        m.loop->run(m.step, until - m.step, m.plan.clock.step, 0);
        m.step = until;
        m.open_when_due();
        if (m.step == m.next_look || m.step == m.plan.steps) m.look_at_health();
    }
}

void Simulation::remove(const std::vector<std::int32_t>& ids) {
    impl_->loop->remove(ids, impl_->step);
}

std::int32_t Simulation::insert(const std::vector<NewGrain>& grains) {
    const std::int32_t first = impl_->loop->insert(grains);
    impl_->set_orientations();
    impl_->next_look = impl_->step;  // they must overlap nothing
    return first;
}

const Traffic& Simulation::traffic() const {
    return impl_->loop->traffic();
}

std::vector<Departure> Simulation::take_departures() {
    return impl_->loop->take_departures();
}

std::int64_t Simulation::step() const {
    return impl_->step;
}
std::size_t Simulation::grains() const {
    return impl_->grains.size();
}
int Simulation::threads() const {
    return impl_->team.size();
}

Frame Simulation::frame() const {
    const Impl& m = *impl_;
    Frame f;
    f.step = m.step;
    f.time = m.plan.clock.time(m.step);
    f.cycles = m.plan.clock.cycles(m.step);
    f.phase = m.plan.clock.phase(m.step);
    f.bodies = poses_of(m.bodies, m.around.motion.at(m.step));
    const Grains& g = m.grains;
    std::vector<std::int32_t> by_id(g.size());
    std::iota(by_id.begin(), by_id.end(), 0);
    std::sort(by_id.begin(), by_id.end(), [&](std::int32_t a, std::int32_t b) { return g.id[a] < g.id[b]; });
    for (const std::int32_t i : by_id) {
        f.id.push_back(g.id[i]);
        f.species.push_back(g.species[i]);
        f.radius.push_back(g.place[i].radius);
        Vec3 x = g.place[i].position;
        x.x() = nearest_image(x.x(), m.around.period);
        f.position.push_back(x);
        f.velocity.push_back(g.motion[i].velocity);
        f.spin.push_back(g.motion[i].spin);
        if (!g.orientation.empty()) f.orientation.push_back(g.orientation[i]);
    }
    return f;
}

double Simulation::centre_height() const {
    const Impl& m = *impl_;
    double moment = 0, mass = 0;
    for (std::size_t i = 0; i < m.grains.size(); ++i) {
        moment += m.grains.mass(i) * m.grains.place[i].position.z();
        mass += m.grains.mass(i);
    }
    if (mass == 0) return std::numeric_limits<double>::quiet_NaN();
    return moment / mass - m.around.motion.at(m.step).offset.z();
}

Measures Simulation::Impl::look(Observers& by) const {
    const Moment moment{
        scene,        plan.clock,     grains, step, around.gravity, around.period, around.motion.at(step),
        start_energy, loop->traffic()};
    return by.look(moment, [&](const auto& see) { loop->visit_contacts(step, see); });
}

Measures Simulation::measures() const {
    Impl& m = *impl_;
    if (!m.observers)
        m.observers = std::make_unique<Observers>(all_observers(), m.species_names,
                                                  [](const std::string&) { return true; });
    return m.look(*m.observers);
}

double Simulation::measure(const std::string& column) const {
    Observers of_column(all_observers(), impl_->species_names,
                        [&](const std::string& name) { return name == column; });
    return impl_->look(of_column).at(column);
}

std::uint64_t Simulation::state_hash() const {
    std::ostringstream out;
    write_state(out, impl_->step, impl_->grains, *impl_->loop);
    const std::string bytes = out.str();
    return XXH64(bytes.data(), bytes.size(), 0);
}

std::vector<Simulation::ContactRecord> Simulation::contacts() const {
    std::vector<ContactRecord> records;
    impl_->loop->visit_contacts(impl_->step, [&](const ContactView& c) {
        if (c.normal_force <= 0) return;
        const std::int32_t second = c.second >= 0 ? impl_->grains.id[c.second] : c.second;
        records.push_back({impl_->grains.id[c.first], second, c.normal_force, c.tangential, c.point});
    });
    // Each thread shows its own, which is no order to go by.
    std::sort(records.begin(), records.end(), [](const ContactRecord& a, const ContactRecord& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
    return records;
}

void Simulation::save_checkpoint(const std::filesystem::path& path) const {
    const Impl& m = *impl_;
    CheckpointHeader header;
    header.step = m.step;
    header.start_energy = m.start_energy;
    if (m.scene.drive.moves == Drive::Moves::container) {
        header.wall_offset = m.around.motion.at(m.step).offset;
        header.wall_velocity = m.around.motion.at(m.step).velocity;
    }
    grainreel::save_checkpoint(path, m.scene, m.plan, header, m.grains, *m.loop);
}

}  // namespace grainreel
