// Density, velocity, temperature and stress on a grid; see engine/measure/fields/coarse_graining.hpp.
#pragma once

#include "engine/measure/fields/field_names.hpp"
#include "engine/measure/fields/field_record.hpp"
#include "engine/measure/fields/field_state.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class CoarseGrainedFields final : public Observer {
  public:
    CoarseGrainedFields(const Scene& scene, const Plan& plan)
        : record_(scene, plan.fields), set_(coarse_field_set(scene, record_.sums())) {}

    static std::vector<ColumnGroup> columns(const Scene&) { return {}; }
    static bool wanted(const Scene& scene) { return scene.output.fields.wanted(); }

    bool needs_contacts() const override { return true; }
    void begin(const Moment& m) override {
        state_.grains.clear();
        state_.contacts.clear();
        for (std::size_t i = 0; i < m.grains.size(); ++i) state_.grains.push_back(field_grain(m, i));
    }
    void contact(const Moment& m, const ContactView& c) override {
        // Latched springs and grains that part touch without a force.
        if (c.normal_force == 0 && c.tangential.isZero(0)) return;
        state_.contacts.push_back(field_contact(m, c));
    }
    void look(const Moment&, std::vector<double>&) override {}

    const FieldSet* fields() const override { return &set_; }
    FieldValues look_at_fields(const Moment&) override {
        return coarse_field_values(record_.last(), record_.sums());
    }

    std::int64_t gathers_after(std::int64_t step) const override { return record_.times().next(step); }
    void start(const Moment& m) override { record_.start(m.step, state_); }
    void gather(const Moment& m) override { record_.gather(m.step, state_); }
    void save(std::ostream& out) const override { record_.save(out); }
    void load(const Moment&, Bytes& in) override { record_.load(in); }

  private:
    FieldRecord record_;
    FieldSet set_;
    FieldState state_;
};

}  // namespace grainreel::observers
