// What the grains hold, what moving walls have put in, and the rest of that balance.
#pragma once

#include "engine/measure/energy/energy.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class Energies final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        constexpr Dimension energy = Dimension::energy;
        return {
            {{{"kinetic_J", "kinetic energy", energy}, {"rotational_J", "energy of rotation", energy}},
             "J",
             "of all grains: translation, spin"},
            {{{"gravitational_J", "potential energy", energy}}, "J", "0 at the middle of the floor at rest"},
            {{{"elastic_J", "elastic energy", energy}}, "J", "what the contacts would give back"},
            {{{"wall_work_J", "work of the walls", energy}},
             "J",
             "done on the grains by moving walls since the drive started"},
            {{{"lost_J", "energy lost", energy}},
             "J",
             "the rest of the balance: energy at the start + `wall_work_J` - the four energies above"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const Moment&) override { elastic_ = 0; }
    void contact(const Moment&, const ContactView& c) override { elastic_ += c.stored_energy; }
    void look(const Moment& m, std::vector<double>& row) override {
        const Kinetic kinetic = kinetic_energy(m.grains);
        const double high = gravitational_energy(m.grains, m.gravity);
        const double work = wall_work(m.grains) + m.traffic.work_out;
        const double lost = m.start_energy + m.traffic.energy_in - m.traffic.energy_out + work -
                            kinetic.translation - kinetic.rotation - high - elastic_;
        row.insert(row.end(), {kinetic.translation, kinetic.rotation, high, elastic_, work, lost});
    }

  private:
    double elastic_ = 0;  // J
};

}  // namespace grainreel::observers
