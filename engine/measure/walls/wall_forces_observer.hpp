// Observer of each wall: the mean force on it and its moment, the weight that it carries, and the pressure by
// height. A wall that turns also has the torque about its axis. A wall that turns or moves by itself has the
// power that it gives to the grains (WallWork in wall_faces.hpp). The forces are summed at every step, so
// that no impact is missed. Forces are means between two rows of measures.csv. Pressures are means over a
// record of fields.nc.
//
// Between the steps n1 < n2 the impulse on a face is dt (C(n2) - C(n1)) with C(n) = F_1 + ... + F_n - (1 - s)
// F_n, where s is the share of a step's force that the grains have felt by its end: 1/2 with velocity Verlet.
// So the impulse of all walls is the change of the grains' momentum minus the impulse of gravity, except for
// rounding (sums of eqs. 4 and 5 of Swope et al. 1982, J. Chem. Phys. 76, 637). Gear's method corrects places
// and velocities with other weights, so with it this holds only to the order of the step.
#pragma once

#include <algorithm>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel::observers {

class WallForces final : public Observer {
  public:
    static constexpr const char* instrument = "walls";

    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups;
        const std::vector<WallBody> walls = wall_bodies(scene);
        std::size_t wall = 0;
        for (const std::string& face : face_names(scene)) {
            groups.push_back({of_axes(face + "_force", "N", "force on " + face, Dimension::force), "N",
                              "mean force of the grains on a wall, of every step since the row before"});
            groups.push_back(
                {of_axes(face + "_moment", "N.m", "moment on " + face, Dimension::moment), "N m",
                 "its moment about the middle of the floor at rest, which moves with the wall; of "
                 "a plane about its `point`; of a mesh about its `position`, and of what turns about "
                 "`through`, a point of the axis"});
            groups.push_back({{{face + "_carries", "weight carried by " + face}},
                              "1",
                              "the force along gravity, divided by the weight of all grains"});
            const WallBody& body = walls.at(wall++);
            if (body.turns)
                groups.push_back({{{face + "_torque_N.m", "torque on " + face, Dimension::moment}},
                                  "N m",
                                  "of a wall that turns: the part of that moment along its axis; below 0 "
                                  "where the grains brake"});
            if (!body.fixed)
                groups.push_back(
                    {{{face + "_power_W", "power of " + face, Dimension::power}},
                     "W",
                     "of a wall that turns or moves by itself: the work that it gives the grains "
                     "over time, by the impulses of every step since the row before"});
        }
        return groups;
    }

    WallForces(const Scene& scene, const Plan& plan)
        : rows_(plan),
          records_(plan.fields),
          profile_(scene),
          walls_(wall_bodies(scene)),
          work_(scene, plan) {}

    bool needs_wall_sums() const override { return true; }
    const FieldSet* fields() const override {
        return profile_.fields().fields.empty() ? nullptr : &profile_.fields();
    }
    std::int64_t gathers_after(std::int64_t step) const override {
        return std::min({rows_.after(step), records_.next_end(step + 1), work_.gathers_after(step)});
    }

    // If a run goes on without the data gathered before, the present record has no pressures, because it
    // begins in the middle.
    void start(const ObservedState& m) override {
        work_.start(m);
        last_ = before_ = {m.step, m.wall_sums->faces, work_.until(m)};
        record_ = {m.step, {}};
        if (m.step == 0 || records_.ends_record(m.step)) record_.slices = m.wall_sums->slices;
        record_before_ = {m.step, {}};
    }
    void gather(const ObservedState& m) override {
        work_.gather(m);
        if (rows_.after(m.step - 1) == m.step) {
            before_ = std::move(last_);
            last_ = {m.step, m.wall_sums->faces, work_.until(m)};
        }
        if (!records_.ends_record(m.step)) return;
        record_before_ = std::move(record_);
        record_ = {m.step, m.wall_sums->slices};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        const Noted& from = last_.step < m.step ? last_ : before_;
        const auto steps = static_cast<double>(m.step - from.step);
        const double weight = mass_of(m.grains) * m.gravity.squaredNorm();
        const std::vector<double> work = work_.until(m);
        for (std::size_t f = 0; f < from.faces.size(); ++f) {
            const WallSum all = sum_between(from.faces[f], m.wall_sums->faces[f], *m.wall_sums);
            // This is NaN until there is a step to average over.
            const Vec3 force = all.force / steps;
            Vec3 moment = all.moment / steps;
            const WallBody& wall = walls_.at(f);
            if (!wall.mesh && !wall.turns && m.faces[f].body.number < kFirstPlaneBody)
                moment += m.faces[f].point.cross(force);
            row.insert(row.end(), {force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z(),
                                   force.dot(m.gravity) / weight});
            if (wall.turns) row.push_back(moment.dot(wall.axis));
            if (!wall.fixed) row.push_back((work[f] - from.work.at(f)) / (steps * m.clock.step));
        }
    }
    FieldValues look_at_fields(const ObservedState& m) override {
        const Record& from = record_.step < m.step ? record_ : record_before_;
        std::vector<double> normal(m.wall_sums->slices.size(), kUnknown);
        const double per_step = m.wall_sums->scale.force / static_cast<double>(m.step - from.step);
        for (std::size_t s = 0; s < from.slices.size(); ++s)
            normal[s] = per_step * static_cast<double>(m.wall_sums->slices[s] - from.slices[s]);
        return profile_.pressures(normal);
    }

    void save(std::ostream& out) const override {
        name_all(*this, Writing{out});
        work_.save(out);
    }
    void load(const ObservedState& m, Bytes& in) override {
        name_all(*this, Reading{in});
        work_.load(m, in);
        const std::size_t walls = m.wall_sums->faces.size(), works = work_.any() ? walls : 0;
        const auto are_slices = [&](const Record& record) {
            return record.slices.empty() ||
                   (record.slices.size() == m.wall_sums->slices.size() && are_sound(record.slices));
        };
        if (record_before_.step < 0 || record_before_.step > record_.step || record_.step > m.step ||
            before_.step < 0 || before_.step > last_.step || last_.step > m.step ||
            !are_slices(record_before_) || !are_slices(record_) || last_.faces.size() != walls ||
            before_.faces.size() != walls || last_.work.size() != works || before_.work.size() != works ||
            !are_sound(last_.faces) || !are_sound(before_.faces))
            in.fail();
    }

  private:
    struct Noted {
        std::int64_t step = 0;
        std::vector<FaceSums> faces;
        std::vector<double> work = {};  // J, given by each wall; empty if no wall moves by itself
    };
    struct Record {
        std::int64_t step = 0;
        std::vector<WideInt> slices;  // empty if not known
    };
    template <class Self, class Each>
    static void name_all(Self& self, const Each& each) {
        for (auto* noted : {&self.last_, &self.before_}) each(noted->step), each(noted->faces);
        if (self.work_.any())
            for (auto* noted : {&self.last_, &self.before_}) each(noted->work);
        for (auto* record : {&self.record_, &self.record_before_}) each(record->step), each(record->slices);
    }

    static std::vector<MeasureColumn> of_axes(const std::string& name, const std::string& unit,
                                              const std::string& label, Dimension dimension) {
        std::vector<MeasureColumn> columns;
        for (const char* axis : {"x", "y", "z"})
            columns.push_back({name + "_" + axis + "_" + unit, label + ", " + axis, dimension});
        return columns;
    }
    static double mass_of(const Grains& grains) {
        double mass = 0;
        for (std::size_t i = 0; i < grains.size(); ++i) mass += grains.mass(i);
        return mass;
    }

    const Rows rows_;
    const FieldTimes records_;
    PressureProfile profile_;
    const std::vector<WallBody> walls_;
    WallWork work_;
    Noted last_, before_;            // at the last two rows
    Record record_, record_before_;  // at the last two ends of records
};

}  // namespace grainreel::observers
