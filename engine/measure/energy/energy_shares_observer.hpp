// Where the energy goes, term by term: each is measured at the contacts, and none is the rest of the others.
// The formulas are those of engine/measure/energy/energy_balance.hpp.
#pragma once

#include <optional>

#include "engine/measure/energy/energy_balance.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

// It looks at all contacts after every step, so that a run takes several times as long.
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
    void start(const Moment& m) override { begin_balance(m); }
    void gather(const Moment& m) override { balance_->note(m.step); }
    void look(const Moment&, std::vector<double>& row) override {
        const EnergyTerms& terms = balance_->terms();
        row.insert(row.end(), {terms.latching, terms.friction, terms.damping, balance_->residual()});
    }
    void save(std::ostream& out) const override { balance_->save(out); }
    void load(const Moment& m, Bytes& in) override {
        begin_balance(m);
        balance_->load(in);
    }

  private:
    void begin_balance(const Moment& m) {
        balance_.emplace(*m.around, m.grains, *m.loop, m.step, m.clock.step);
    }

    std::optional<EnergyBalance> balance_;
};

}  // namespace grainreel::observers
