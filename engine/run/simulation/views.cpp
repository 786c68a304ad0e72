// What leaves a simulation: frames, measures, fields and contacts.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "engine/run/simulation/simulation_impl.hpp"
#include "engine/step/grid/neighbours.hpp"

namespace grainreel {

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
            loop.get(),
            feeder.given()};
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

std::vector<ContactRecord> Simulation::contacts() const {
    std::vector<ContactRecord> records;
    impl_->loop->visit_contacts(impl_->step, [&](const ContactView& c) {
        if (c.normal_force <= 0) return;
        const std::int32_t second = c.second >= 0 ? impl_->grains.id[c.second] : c.second;
        records.push_back(
            {impl_->grains.id[c.first], second, c.normal_force, c.tangential, c.point, c.triangle});
    });
    // Each thread shows its own, which is no order to go by.
    std::sort(records.begin(), records.end(), [](const ContactRecord& a, const ContactRecord& b) {
        return std::tie(a.first, a.second, a.triangle) < std::tie(b.first, b.second, b.triangle);
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
        const std::int32_t mesh = -1 - c.second - static_cast<std::int32_t>(m.around.faces.size());
        const PairPlan& law =
            pair ? m.plan.between(species(c.first), species(c.second))
            : mesh >= 0
                ? m.plan.mesh[static_cast<std::size_t>(mesh) * m.scene.species.size() + species(c.first)]
                : m.plan.wall[species(c.first)];
        forces.push_back({m.grains.id[c.first], pair ? m.grains.id[c.second] : c.second, c.normal, c.overlap,
                          c.normal_force, c.tangential, c.torque_on_first,
                          pair ? c.torque_on_second : Vec3::Zero(), law.friction, c.point, c.smaller_radius,
                          c.stored_energy, c.triangle});
    });
    std::sort(forces.begin(), forces.end(), [](const ContactForce& a, const ContactForce& b) {
        return std::tie(a.first, a.second, a.triangle) < std::tie(b.first, b.second, b.triangle);
    });
    return forces;
}

}  // namespace grainreel
