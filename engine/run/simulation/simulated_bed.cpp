#include "engine/run/simulation/simulated_bed.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/base/team.hpp"
#include "engine/measure/energy.hpp"
#include "engine/mesh/room.hpp"
#include "engine/run/simulation/simulated_bed_impl.hpp"
#include "engine/start/rain.hpp"
#include "engine/state/traffic.hpp"
#include "engine/step/grid/neighbours.hpp"

namespace grainreel {

void check_start(const Scene& scene, const Plan& plan) {
    if (!scene.start.packs()) SimulatedBed(scene, plan, 1);
}

SimulatedBed::SimulatedBed(const Scene& scene, const Plan& plan, int threads)
    : impl_(std::make_unique<Impl>(scene, plan, threads)) {
    if (impl_->continued) impl_->check_not_over();
}
SimulatedBed::SimulatedBed(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

SimulatedBed::~SimulatedBed() = default;
SimulatedBed::SimulatedBed(SimulatedBed&&) noexcept = default;
SimulatedBed& SimulatedBed::operator=(SimulatedBed&&) noexcept = default;

void SimulatedBed::Impl::open_when_due() {
    if (opened || !plan.opens || step < *plan.opens) return;
    loop->open_faces([&] { open_outlet(scene, around); }, step);
    opened = true;
}

std::int32_t SimulatedBed::Impl::insert(const std::vector<ComingGrain>& more) {
    const std::int32_t first = loop->insert(more);
    if (more.empty()) return first;
    set_orientations();
    next_look = step;  // new grains must overlap nothing
    return first;
}

void SimulatedBed::Impl::note_overlap(DeepestContact now) {
    if (now.share > deepest.share) deepest = std::move(now);
}

void SimulatedBed::note_overlap() {
    Impl& m = *impl_;
    m.note_overlap(grainreel::deepest_contact(m.limits, m.around, m.grains, m.contacts(), m.step));
}

const DeepestContact& SimulatedBed::deepest_contact() const {
    return impl_->deepest;
}

void SimulatedBed::set_deepest_contact(DeepestContact former) {
    if (former.step <= impl_->step) impl_->note_overlap(std::move(former));
}

double SimulatedBed::told_overlap() const {
    return impl_->limits.told();
}

std::string SimulatedBed::overlap_text() const {
    return grainreel::overlap_text(impl_->limits, impl_->deepest);
}

void SimulatedBed::Impl::look_at_health() {
    note_overlap(check_state(limits, around, grains, *loop, step));
    // The allowance is the work of a hundredth of the bed's weight along one radius. So a bed at rest is not
    // stopped by round-off, or by energy that a law makes in closed loops.
    const Traffic& traffic = loop->traffic();
    const Kinetic kinetic = kinetic_energy(grains);
    const double work = wall_work(grains) + traffic.work_out;
    double allowance = 0, through = kinetic.translation + kinetic.rotation + std::abs(work) +
                                    std::abs(traffic.energy_out) + std::abs(traffic.energy_in);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const double mass = grains.mass(i);
        allowance += 0.01 * mass * around.gravity.norm() * grains.place[i].radius;
        through += mass * std::abs(around.gravity.dot(grains.place[i].position));
    }
    energy_watch.check(total_energy(around, grains, *loop, step) + traffic.energy_out - traffic.energy_in,
                       work, through, allowance, limits, grains, step);
    next_look = step + steps_to_next_look(limits, around, grains, step);
}

void SimulatedBed::advance(std::int64_t target) {
    Impl& m = *impl_;
    while (m.step < target) {
        if (m.next_look <= m.step) m.look_at_health();  // the first look is at the start
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

void SimulatedBed::remove(const std::vector<std::int32_t>& ids) {
    impl_->loop->remove(ids, impl_->step);
}

std::int32_t SimulatedBed::insert(const std::vector<ComingGrain>& grains) {
    return impl_->insert(grains);
}

const Traffic& SimulatedBed::traffic() const {
    return impl_->loop->traffic();
}

std::vector<Departure> SimulatedBed::take_departures() {
    return impl_->loop->take_departures();
}

std::int64_t SimulatedBed::step() const {
    return impl_->step;
}
std::size_t SimulatedBed::grains() const {
    return impl_->grains.size();
}
int SimulatedBed::threads() const {
    return impl_->team.size();
}

// Output of a simulation: frames, measures, fields and contacts.
State SimulatedBed::frame() const {
    const Impl& m = *impl_;
    State f;
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

ObservedState SimulatedBed::Impl::moment() {
    if (observers.need_wall_sums()) wall_sums = loop->wall_sums();
    return {.scene = scene,
            .clock = plan.clock,
            .grains = grains,
            .step = step,
            .gravity = around.gravity,
            .period = around.period,
            .pose = around.motion.at(step),
            .start_energy = start_energy,
            .traffic = loop->traffic(),
            .faces = around.faces,
            .wall_sums = wall_sums ? &*wall_sums : nullptr,
            .around = &around,
            .loop = loop.get(),
            .fed = feeder.given()};
}

ShowContacts SimulatedBed::Impl::contacts() const {
    return [this](const auto& see) { loop->visit_contacts(step, see); };
}

Measures SimulatedBed::measures() const {
    return impl_->observers.look(impl_->moment(), impl_->contacts());
}

double SimulatedBed::measure(const std::string& column) const {
    return impl_->observers.look(impl_->moment(), impl_->contacts(), column);
}

const std::vector<std::string>& SimulatedBed::measured() const {
    return impl_->observers.names();
}

std::vector<const FieldSet*> SimulatedBed::field_sets() const {
    return impl_->observers.fields();
}

std::vector<FieldValues> SimulatedBed::fields() const {
    return impl_->observers.look_at_fields(impl_->moment(), impl_->contacts());
}

std::vector<SavedContact> SimulatedBed::contacts() const {
    std::vector<SavedContact> contacts;
    impl_->loop->visit_contacts(impl_->step, [&](const ContactView& c) {
        if (c.normal_force <= 0) return;
        const std::int32_t second = c.second >= 0 ? impl_->grains.id[c.second] : c.second;
        contacts.push_back({impl_->grains.id[c.first], second, c.normal_force, c.tangential, c.point,
                            c.triangle, c.rolling});
    });
    // Each thread shows its own contacts, so their order must be set here.
    std::sort(contacts.begin(), contacts.end(), [](const SavedContact& a, const SavedContact& b) {
        return std::tie(a.first, a.second, a.triangle) < std::tie(b.first, b.second, b.triangle);
    });
    return contacts;
}

std::vector<DetailedContact> SimulatedBed::contact_forces() const {
    const Impl& m = *impl_;
    const auto species = [&](std::int32_t grain) {
        return static_cast<std::size_t>(m.grains.species[grain]);
    };
    std::vector<DetailedContact> forces;
    m.loop->visit_contacts(m.step, [&](const ContactView& c) {
        const bool pair = c.second >= 0;
        const std::int32_t mesh = -1 - c.second - static_cast<std::int32_t>(m.around.faces.size());
        const PairPlan& law =
            pair ? m.plan.between(species(c.first), species(c.second))
            : mesh >= 0
                ? m.plan.mesh[static_cast<std::size_t>(mesh) * m.scene.species.size() + species(c.first)]
            : c.glued >= 0 ? m.plan.glued[species(c.first)]
                           : m.plan.wall[species(c.first)];
        forces.push_back({.first = m.grains.id[c.first],
                          .second = pair ? m.grains.id[c.second] : c.second,
                          .normal = c.normal,
                          .overlap = c.overlap,
                          .normal_force = c.normal_force,
                          .tangential = c.tangential,
                          .torque_on_first = c.torque_on_first,
                          .torque_on_second = pair ? c.torque_on_second : Vec3::Zero(),
                          .friction = law.friction,
                          .point = c.point,
                          .smaller_radius = c.smaller_radius,
                          .stored_energy = c.stored_energy,
                          .triangle = c.triangle});
    });
    // A grain may touch several grains glued to one face; then the place decides.
    const auto order = [](const DetailedContact& c) {
        return std::tuple(c.first, c.second, c.triangle, c.point.x(), c.point.y(), c.point.z());
    };
    std::sort(forces.begin(), forces.end(),
              [&](const DetailedContact& a, const DetailedContact& b) { return order(a) < order(b); });
    return forces;
}

namespace {

constexpr double kLeastPatience = 20;  // looks

// Time (s) for which a grain may wait for a place: twice the time of a fall through the container, so that
// the grain before it can leave the feed's box, but at least kLeastPatience looks.
double patience(const Scene& scene, double look) {
    const double gravity = scene.gravity.norm();
    const double height = scene.container.height - scene.container.base();
    const double fall = gravity > 0 ? std::sqrt(2 * height / gravity) : 0;
    return std::max(2 * fall, kLeastPatience * look);
}

// Whether the vessel's room contains a part of the feed's box. Grains then come only in the room, because a
// box may lie across the walls of a vessel.
bool reaches_into_vessel(const Scene& scene, const Feed& feed) {
    constexpr int places = 9;  // along each axis
    for (int at = 0; at < places * places * places; ++at) {
        const Vec3 share = Vec3(at % places, at / places % places, at / (places * places)) / (places - 1);
        if (scene.container.room->holds(feed.low + share.cwiseProduct(feed.high - feed.low))) return true;
    }
    return false;
}

}  // namespace

Feeder::Feeder(const Scene& scene, const Plan& plan, const Surroundings& around)
    : scene_(scene), clock_(plan.clock), around_(around), given_(scene.feeds.size(), 0) {
    const bool mesh = scene.container.shape == Container::Shape::mesh;
    for (const Feed& feed : scene.feeds) into_vessel_.push_back(mesh && reaches_into_vessel(scene, feed));
}

std::int64_t Feeder::next_look(std::int64_t step) const {
    if (given_.empty()) return std::numeric_limits<std::int64_t>::max();
    return (step / kStepsPerLook + 1) * kStepsPerLook;
}

std::vector<ComingGrain> Feeder::take(std::int64_t step, const Grains& grains) {
    const double time = clock_.time(step);
    std::vector<ComingGrain> more;
    for (std::size_t k = 0; k < scene_.feeds.size(); ++k) {
        const Feed& feed = scene_.feeds[k];
        const std::int64_t due = feed.due(time);
        if (given_[k] >= due) continue;
        const double largest = 0.5 * scene_.species[feed.species].diameter.largest;
        FreePlaces free(around_, around_.motion.at(step), grains, feed.low, feed.high, largest);
        if (into_vessel_[k])
            free.only_where([this](const Vec3& place) { return scene_.container.room->holds(place); });
        for (const ComingGrain& other : more) free.add({other.position, other.radius});
        for (; given_[k] < due; ++given_[k]) {
            ComingGrain grain = fed_grain(scene_, k, given_[k]);
            Random random(scene_.run.seed, Stream::feed_places,
                          {static_cast<std::int64_t>(k), given_[k], step});
            const auto place = free.take(grain.radius, random);
            if (!place) break;
            grain.position = *place;
            more.push_back(grain);
        }
        if (given_[k] < due) check_patience(k, time);
    }
    return more;
}

// Throws RunError if the next grain of a feed has waited too long for a place. `time` is in s.
void Feeder::check_patience(std::size_t feed, double time) const {
    const Feed& from = scene_.feeds[feed];
    const double waited = time - from.from - static_cast<double>(given_[feed] + 1) / from.rate;
    if (waited <= patience(scene_, kStepsPerLook * clock_.step)) return;
    throw RunError(
        "{}: at {:.6g} s grain {} of \"{}\" has waited {:.3g} s for a place where nothing is: where they "
        "appear it is full; lower the 'rate', end it earlier ('until', 'count'), or enlarge the box or "
        "the container",
        scene_.where(fmt::format("feed[{}]", feed)), time, given_[feed] + 1,
        scene_.species[from.species].name, waited);
}

constexpr std::int64_t grains_a_thread =
    500;  // with fewer grains, a further thread costs more time at barriers than it saves

int useful_threads(int processors, std::int64_t grains) {
    return static_cast<int>(std::clamp<std::int64_t>(grains / grains_a_thread, 1, processors));
}

int engine_threads(const Scene& scene) {
    return useful_threads(scene.run.threads > 0 ? scene.run.threads : usable_processors(), scene.grains());
}

}  // namespace grainreel
