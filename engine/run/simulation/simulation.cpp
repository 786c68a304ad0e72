#include <algorithm>
#include <cmath>

#include "engine/measure/energy/energy.hpp"
#include "engine/run/simulation/simulation_impl.hpp"

namespace grainreel {

void check_start(const Scene& scene, const Plan& plan) {
    if (!scene.start.packs()) Simulation(scene, plan, 1);
}

Simulation::Simulation(const Scene& scene, const Plan& plan, int threads)
    : impl_(std::make_unique<Impl>(scene, plan, threads)) {
    if (impl_->continued) impl_->check_not_over();
}
Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

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

void Simulation::Impl::look_at_health() {
    check_state(limits, around, grains, *loop, step);
    // Round-off and a law's own closed loops must not stop a bed at rest: a hundredth of its weight over a
    // radius.
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

}  // namespace grainreel
