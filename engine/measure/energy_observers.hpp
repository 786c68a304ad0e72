// Observers of energy: the energies at each row, and the shares of the energy balance.
#pragma once

#include <optional>

#include "engine/measure/energy.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

// Observer of the energies of the grains, the work of moving walls, and the energy lost, which is inferred as
// the rest of this balance.
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
    void begin(const ObservedState&) override { elastic_ = 0; }
    void contact(const ObservedState&, const ContactView& c) override { elastic_ += c.stored_energy; }
    void look(const ObservedState& m, std::vector<double>& row) override {
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

// Observer of the terms of the energy balance. Each term is measured at the contacts, and none is inferred
// from the others. The formulas are those of engine/measure/energy.hpp. This observer looks at all contacts
// after every step, so a run takes several times as long.
class EnergyShares final : public Observer {
  public:
    static constexpr const char* instrument = "energy_balance";

    static std::vector<ColumnGroup> columns(const Scene&) {
        constexpr Dimension energy = Dimension::energy;
        return {{{{"latching_J", "energy lost to latching", energy},
                  {"friction_J", "energy lost to friction", energy},
                  {"damping_J", "energy lost to dashpots", energy}},
                 "J",
                 "what contacts have taken since the drive started, measured at every step"},
                {{{"balance_error_J", "error of the energy balance", energy}},
                 "J",
                 "what the grains hold beyond what the balance of all terms says: the error of the finite "
                 "step"}};
    }

    std::int64_t gathers_after(std::int64_t step) const override { return step + 1; }
    void start(const ObservedState& m) override { begin_balance(m); }
    void gather(const ObservedState& m) override { balance_->note(m.step); }
    void look(const ObservedState&, std::vector<double>& row) override {
        const EnergyTerms& terms = balance_->terms();
        row.insert(row.end(), {terms.latching, terms.friction, terms.damping, balance_->residual()});
    }
    void save(std::ostream& out) const override { balance_->save(out); }
    void load(const ObservedState& m, Bytes& in) override {
        begin_balance(m);
        balance_->load(in);
    }

  private:
    void begin_balance(const ObservedState& m) {
        balance_.emplace(*m.around, m.grains, *m.loop, m.step, m.clock.step);
    }

    std::optional<EnergyBalance> balance_;
};

}  // namespace grainreel::observers
