// The observer of coarse-grained fields (density, velocity, temperature, stress): what it takes from a moment
// of a run, the fields' names and units, and their means over the records (stretches of time) of fields.nc.
// The formulas are in coarse_graining.hpp.
#pragma once

#include <iosfwd>
#include <optional>

#include "engine/base/binary.hpp"
#include "engine/base/numbers.hpp"
#include "engine/measure/fields/coarse_graining.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/plan/times.hpp"

namespace grainreel {

// The functions from here to field_contact() make the input of coarse-graining from the state at one moment.
//
// seen_from() is the pose relative to which places and velocities are given. It is the container's if the
// drive moves the container, and that of the lab if the drive moves only the floor.
inline DrivePose seen_from(const ObservedState& moment) {
    return moment.scene.drive.moves == Drive::Moves::container ? moment.pose : DrivePose();
}

inline Vec3 field_place(const ObservedState& moment, std::size_t grain) {
    Vec3 place = moment.grains.place[grain].position;
    place.x() = nearest_image(place.x(), moment.period);
    return place - seen_from(moment).offset;
}

inline FieldGrain field_grain(const ObservedState& moment, std::size_t grain) {
    const std::int32_t species = moment.grains.species[grain];
    const double mass = moment.grains.mass(grain);
    return {field_place(moment, grain),
            moment.grains.motion[grain].velocity - seen_from(moment).velocity,
            mass,
            mass / moment.scene.species[species].density,
            species,
            moment.grains.place[grain].radius};
}

// At a wall the branch ends on the wall's face.
inline FieldBranch field_contact(const ObservedState& moment, const ContactView& contact) {
    const auto first = static_cast<std::size_t>(contact.first);
    const bool pair = contact.second >= 0;
    const double radius = moment.grains.place[first].radius;
    const double other = pair ? moment.grains.place[contact.second].radius : 0;
    return {field_place(moment, first), (radius - contact.overlap + other) * contact.normal,
            contact.normal_force * contact.normal + contact.tangential, radius, pair ? other : radius};
}

// Names and units of the fields of coarse-graining, as files have them.
FieldSet coarse_field_set(const Scene& scene, const CoarseGraining& by);

// The values in the order of coarse_field_set(). Without `fields` all are NaN, except the cells' volumes.
FieldValues coarse_field_values(const std::optional<CoarseFields>& fields, const CoarseGraining& by);

// Gathers moments while a run goes on, and computes the mean of each record when the record ends.
class FieldMeans {
  public:
    FieldMeans(const Scene& scene, const FieldTimes& times);

    const CoarseGraining& sums() const { return sums_; }
    const FieldTimes& times() const { return times_; }
    // Call this at the step where the run begins, or where it goes on without the moments gathered before. In
    // the second case gathering waits for the next record. `state` is the state at the step.
    void start(std::int64_t step, const FieldState& state);
    // Call this at every step that times().next() gives.
    void gather(std::int64_t step, const FieldState& state);
    // The mean over the record that ended last; none before the first has ended.
    const std::optional<CoarseFields>& last() const { return last_; }

    // Saves the sums of the present record, and the mean of a record that has just ended, because that may
    // not have been written yet.
    void save(std::ostream& out) const;
    // Reading fails for anything that save() cannot have written. Sums that were gathered with other settings
    // are ignored, and gathering then waits for the next record.
    void load(Bytes& in);

  private:
    FieldTimes times_;
    std::vector<double> settings_;  // saved with the sums; load() ignores sums with other settings
    CoarseGraining sums_;
    void load_last(Bytes& in);

    bool open_ = false;   // whether a record has begun
    bool ended_ = false;  // whether a record ended at the step that was gathered last
    std::optional<CoarseFields> last_;
};

}  // namespace grainreel

namespace grainreel::observers {

class CoarseGrainedFields final : public Observer {
  public:
    CoarseGrainedFields(const Scene& scene, const Plan& plan)
        : means_(scene, plan.fields), set_(coarse_field_set(scene, means_.sums())) {}

    static std::vector<ColumnGroup> columns(const Scene&) { return {}; }
    static bool wanted(const Scene& scene) { return scene.output.fields.wanted(); }

    bool needs_contacts() const override { return true; }
    void begin(const ObservedState& m) override {
        state_.grains.clear();
        state_.contacts.clear();
        for (std::size_t i = 0; i < m.grains.size(); ++i) state_.grains.push_back(field_grain(m, i));
    }
    void contact(const ObservedState& m, const ContactView& c) override {
        // A latched spring, or a contact about to part, touches without a force.
        if (c.normal_force == 0 && c.tangential.isZero(0)) return;
        state_.contacts.push_back(field_contact(m, c));
    }
    void look(const ObservedState&, std::vector<double>&) override {}

    const FieldSet* fields() const override { return &set_; }
    FieldValues look_at_fields(const ObservedState&) override {
        return coarse_field_values(means_.last(), means_.sums());
    }

    std::int64_t gathers_after(std::int64_t step) const override { return means_.times().next(step); }
    void start(const ObservedState& m) override { means_.start(m.step, state_); }
    void gather(const ObservedState& m) override { means_.gather(m.step, state_); }
    void save(std::ostream& out) const override { means_.save(out); }
    void load(const ObservedState&, Bytes& in) override { means_.load(in); }

  private:
    FieldMeans means_;
    FieldSet set_;
    FieldState state_;
};

}  // namespace grainreel::observers
