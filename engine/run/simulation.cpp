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
#include "engine/measure/columns.hpp"
#include "engine/measure/energy/energy.hpp"
#include "engine/measure/health.hpp"
#include "engine/measure/observers.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/wall_faces.hpp"
#include "engine/run/feeder.hpp"
#include "engine/run/surroundings.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/start/rain.hpp"
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
    if (container.shape == Container::Shape::none || grains.size() == 0) return 0;
    const double top = std::clamp(bed_height(heights), 0.0, container.height);
    double solid = 0;
    for (const Place& p : grains.place) {
        if (p.position.z() <= top) solid += 4.0 / 3.0 * std::numbers::pi * std::pow(p.radius, 3);
    }
    return top > 0 ? solid / container.volume_below(top) : 0;
}

}  // namespace

struct Simulation::Impl {
    Impl(const Scene& s, const Plan& p, int threads, bool changes = false)
        : scene(s),
          plan(p),
          team(threads > 0 ? threads : usable_processors()),
          around(make_surroundings(s, p)),
          bodies(bodies_of(s.drive, s.walls)),
          limits(health_limits(s, p)),
          observers(all_observers(), scene, plan),
          may_change(changes) {
        if (!scene.start.packs()) take_grains();
    }

    Scene scene;
    Plan plan;
    Team team;
    Surroundings around;
    std::vector<Body> bodies;
    Grains grains;
    std::unique_ptr<StepLoop> loop;
    Feeder feeder{scene, plan, around};
    std::int64_t step = 0;
    double start_energy = 0;
    HealthLimits limits;
    EnergyWatch energy_watch;
    std::int64_t next_look = 0;  // step

    bool continued = false;  // goes on where the file stopped
    bool opened = false;     // the container's outlet

    Observers observers;
    bool may_change = false;            // whether a run that goes on may be another one from now on
    std::optional<WallSums> wall_sums;  // of the last moment, where an observer needs them

    void make_loop() { loop = std::make_unique<StepLoop>(plan, around, grains, team); }
    void take_grains();
    void go_on();
    void check_not_over() const;
    void set_orientations();
    bool pack_rain(const PackingWatcher& watcher, PackingProgress& progress);
    std::int32_t insert(const std::vector<NewGrain>& more);
    bool pack_layers(const PackingWatcher& watcher, PackingProgress& progress);
    void begin_drive();
    void open_when_due();
    void look_at_health();
    Moment moment();
    void take_gathered(const std::string& bytes);
    std::string gathered() const;
    ShowContacts contacts() const;
};

void check_start(const Scene& scene, const Plan& plan) {
    if (!scene.start.packs()) Simulation(scene, plan, 1);
}

Simulation::Simulation(const Scene& scene, const Plan& plan, int threads)
    : impl_(std::make_unique<Impl>(scene, plan, threads)) {
    if (impl_->continued) impl_->check_not_over();
}
Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Simulation Simulation::at_checkpoint(const Scene& scene, const Plan& plan,
                                     const std::filesystem::path& checkpoint, int threads, bool may_change) {
    Scene there = scene;
    there.start = {};
    there.start.method = Start::Method::file;
    there.start.file = checkpoint.string();
    there.start.keep_clock = true;
    return Simulation(std::make_unique<Impl>(there, plan, threads, may_change));
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

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
    std::string gathered;
    std::vector<std::int64_t> given;
    const CheckpointHeader header =
        continue_from_checkpoint(scene, plan, grains, *loop, gathered, given, may_change);
    feeder.set_given(std::move(given));
    set_orientations();
    step = header.step;
    start_energy = header.start_energy;
    continued = true;
    opened = plan.opens && step >= *plan.opens;
    if (opened) open_outlet(scene, around);
    take_gathered(gathered);
    observers.start(moment(), contacts());
}

void Simulation::Impl::check_not_over() const {
    if (step >= plan.steps)
        throw UserError(
            fmt::format("{}: the start is at step {} already and the run ends at step {}; raise run.duration",
                        scene.where("run.duration"), step, plan.steps));
}

// What was gathered of walls stands before what the observers have gathered. Without it, it begins here.
void Simulation::Impl::take_gathered(const std::string& bytes) {
    Bytes in(bytes);
    WallSums sums;
    read_vector(in, sums.faces);
    read_vector(in, sums.slices);
    if (observers.need_wall_sums()) {
        const WallScale scale = wall_scale(scene, plan);
        const bool there = !sums.faces.empty();
        if (there && !is_sound(sums, around.faces.size(), scale)) in.fail();
        if (in.failed()) throw damaged_checkpoint(scene);
        there ? loop->go_on_tallying(sums, scale) : loop->tally_walls(scale, step);
    }
    observers.load(moment(), in);
    if (in.failed()) throw damaged_checkpoint(scene);
}

std::string Simulation::Impl::gathered() const {
    std::ostringstream out;
    const WallSums sums = observers.need_wall_sums() ? loop->wall_sums() : WallSums();
    write_vector(out, sums.faces);
    write_vector(out, sums.slices);
    observers.save(out);
    return out.str();
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
    if (grains.size() == 0) {  // all that there will be are fed
        make_loop();
        loop->restart();
        return true;
    }
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

bool Simulation::Impl::pack_rain(const PackingWatcher& watcher, PackingProgress& progress) {
    progress.stage = PackingProgress::Stage::raining;
    grains = {};
    make_loop();
    loop->restart();
    const RainReport report = rain(scene, plan, around, grains, *loop, [&](double done, std::int64_t steps) {
        progress.done = done;
        progress.steps = steps;
        return watcher(progress);
    });
    set_orientations();
    return report.finished;
}

// Work and balance count from here; the forces belong to the state, so that the first half kick is right.
void Simulation::Impl::begin_drive() {
    std::fill(grains.wall_work.begin(), grains.wall_work.end(), 0.0);
    loop->begin_account();
    start_energy = total_energy(around, grains, *loop, 0);
    step = 0;
    if (observers.need_wall_sums()) loop->tally_walls(wall_scale(scene, plan), step);
    open_when_due();
    observers.start(moment(), contacts());
}

void Simulation::Impl::open_when_due() {
    if (opened || !plan.opens || step < *plan.opens) return;
    loop->open_faces([&] { open_outlet(scene, around); }, step);
    opened = true;
}

std::int32_t Simulation::Impl::insert(const std::vector<NewGrain>& more) {
    const std::int32_t first = loop->insert(more);
    if (more.empty()) return first;
    set_orientations();
    next_look = step;  // they must overlap nothing
    return first;
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
    if (m.scene.start.method == Start::Method::rain) result.finished = m.pack_rain(watcher, progress);
    if (result.finished) {
        progress.stage = PackingProgress::Stage::settling;
        const auto watch = [&](double done, std::int64_t steps) {
            progress.done = done;
            progress.steps = steps;
            return watcher(progress);
        };
        // From here, for a law may act over a step with another force than it has at its end.
        if (m.observers.need_wall_sums()) m.loop->tally_walls(wall_scale(m.scene, m.plan), -1);
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
        const std::int64_t gathering = m.observers.gathers_after(m.step), feed = m.feeder.next_look(m.step);
        std::int64_t until = std::min({target, m.next_look, gathering, feed});
        if (!m.opened && m.plan.opens) until = std::min(until, *m.plan.opens);
        m.loop->run(m.step, until - m.step, m.plan.clock.step, 0);
        m.step = until;
        m.open_when_due();
        if (m.step == feed) m.insert(m.feeder.take(m.step, m.grains));
        if (m.step == gathering) m.observers.gather(m.moment(), m.contacts());
        if (m.step == m.next_look || m.step == m.plan.steps) m.look_at_health();
    }
}

void Simulation::remove(const std::vector<std::int32_t>& ids) {
    impl_->loop->remove(ids, impl_->step);
}

std::int32_t Simulation::insert(const std::vector<NewGrain>& grains) {
    return impl_->insert(grains);
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
        x.x() = wrapped(x.x(), m.around.period);
        f.position.push_back(x);
        f.velocity.push_back(g.motion[i].velocity);
        f.spin.push_back(g.motion[i].spin);
        if (!g.orientation.empty()) f.orientation.push_back(g.orientation[i]);
    }
    return f;
}

Moment Simulation::Impl::moment() {
    if (observers.need_wall_sums()) wall_sums = loop->wall_sums();
    return {scene,
            plan.clock,
            grains,
            step,
            around.gravity,
            around.period,
            around.motion.at(step),
            start_energy,
            loop->traffic(),
            around.faces,
            wall_sums ? &*wall_sums : nullptr,
            &around,
            loop.get()};
}

ShowContacts Simulation::Impl::contacts() const {
    return [this](const auto& see) { loop->visit_contacts(step, see); };
}

Measures Simulation::measures() const {
    return impl_->observers.look(impl_->moment(), impl_->contacts());
}

double Simulation::measure(const std::string& column) const {
    return impl_->observers.look(impl_->moment(), impl_->contacts(), column);
}

const std::vector<std::string>& Simulation::measured() const {
    return impl_->observers.names();
}

std::vector<const FieldSet*> Simulation::field_sets() const {
    return impl_->observers.fields();
}

std::vector<FieldValues> Simulation::fields() const {
    return impl_->observers.look_at_fields(impl_->moment(), impl_->contacts());
}

std::uint64_t Simulation::state_hash() const {
    std::ostringstream out;
    write_state(out, impl_->step, impl_->grains, *impl_->loop, impl_->feeder.given());
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

std::vector<ContactForce> Simulation::contact_forces() const {
    const Impl& m = *impl_;
    const auto species = [&](std::int32_t grain) {
        return static_cast<std::size_t>(m.grains.species[grain]);
    };
    std::vector<ContactForce> forces;
    m.loop->visit_contacts(m.step, [&](const ContactView& c) {
        const bool pair = c.second >= 0;
        const PairPlan& law =
            pair ? m.plan.between(species(c.first), species(c.second)) : m.plan.wall[species(c.first)];
        forces.push_back({m.grains.id[c.first], pair ? m.grains.id[c.second] : c.second, c.normal, c.overlap,
                          c.normal_force, c.tangential, c.torque_on_first,
                          pair ? c.torque_on_second : Vec3::Zero(), law.friction, c.point});
    });
    std::sort(forces.begin(), forces.end(), [](const ContactForce& a, const ContactForce& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
    return forces;
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
    grainreel::save_checkpoint(path, m.scene, m.plan, header, m.grains, *m.loop, m.gathered(),
                               m.feeder.given());
}

}  // namespace grainreel
