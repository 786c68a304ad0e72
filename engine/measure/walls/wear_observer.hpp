// Observer of the wear of meshes: the work of impacts and of rubbing on each mesh, and the pressure and wear
// on each of its triangles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

// The tally sums, triangle by triangle, what contacts do. A contact exerts the normal force N and the
// tangential force T on the mesh; u is the velocity of the grain's surface relative to the mesh there. The
// contact presses with N. Impacts do the work N max(0, u . n) dt, where n points into the mesh; this work
// compresses the bodies. Rubbing does the work T . u dt. Contacts are looked at every second step, six times
// or more in a collision, and each look counts for the steps since the look before. By Archard's law, wear is
// proportional to the work of rubbing per area (J. F. Archard 1953, J. Appl. Phys. 24, 981, at a constant
// coefficient of friction). The work of impacts causes erosion (I. Finnie 1960, Wear 3, 87).
inline constexpr std::int64_t kLookSteps = 2;

// One number for each triangle of one mesh, since the drive started.
struct WearSums {
    std::vector<double> press;   // N s, integral of the normal force
    std::vector<double> impact;  // J
    std::vector<double> shear;   // J
};

class WearTally {
  public:
    explicit WearTally(const Scene& scene);

    void begin() { seen_.clear(); }
    void contact(const ObservedState& m, const ContactView& c);
    // Adds the contacts seen since begin(), which count for `time` (s). The bits do not depend on the order
    // in which they were seen.
    void add(double time);

    const std::vector<WearSums>& sums() const { return sums_; }  // one for each mesh
    std::vector<WearSums>& sums() { return sums_; }
    bool fits(const std::vector<WearSums>& sums) const;  // whether the sums can belong to these meshes

  private:
    struct Seen {
        std::size_t mesh, triangle;
        std::int32_t grain;           // id of the grain
        double press, impact, shear;  // N, W, W
    };
    std::vector<Body> bodies_;
    std::size_t first_ = 0;  // number of the first mesh as a body
    std::vector<WearSums> sums_;
    std::vector<Seen> seen_;
};

}  // namespace grainreel

namespace grainreel::observers {

class Wear final : public Observer {
  public:
    static constexpr const char* instrument = "wear";

    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups;
        for (const std::string& name : mesh_names(scene)) {
            groups.push_back(
                {{{name + "_impact_work_J", "impact work on " + name, Dimension::energy}},
                 "J",
                 "of a mesh: work of the normal forces while grains come nearer to it, since the "
                 "drive started"});
            groups.push_back({{{name + "_shear_work_J", "shear work on " + name, Dimension::energy}},
                              "J",
                              "of a mesh: work of the tangential forces, since the drive started"});
        }
        return groups;
    }

    Wear(const Scene& scene, const Plan& plan) : records_(plan.fields), tally_(scene) {
        const std::vector<std::string> names = mesh_names(scene);
        for (std::size_t k = 0; k < names.size(); ++k) add_mesh(scene, k, names[k]);
    }

    bool needs_contacts() const override { return true; }
    void begin(const ObservedState&) override { tally_.begin(); }
    void contact(const ObservedState& m, const ContactView& c) override { tally_.contact(m, c); }
    const FieldSet* fields() const override { return areas_.empty() ? nullptr : &set_; }
    std::int64_t gathers_after(std::int64_t step) const override {
        return std::min((step + kLookSteps) / kLookSteps * kLookSteps, records_.next_end(step + 1));
    }
    void start(const ObservedState& m) override {
        step_ = m.step;
        record_ = {m.step, presses()};
        record_before_ = {m.step, {}};
    }
    void gather(const ObservedState& m) override {
        tally_.add(m.clock.step * static_cast<double>(m.step - step_));
        step_ = m.step;
        if (!records_.ends_record(m.step)) return;
        record_before_ = std::move(record_);
        record_ = {m.step, presses()};
    }
    void look(const ObservedState&, std::vector<double>& row) override {
        for (const WearSums& mesh : tally_.sums())
            row.insert(row.end(), {std::accumulate(mesh.impact.begin(), mesh.impact.end(), 0.0),
                                   std::accumulate(mesh.shear.begin(), mesh.shear.end(), 0.0)});
    }
    FieldValues look_at_fields(const ObservedState& m) override {
        const Record& from = record_.step < m.step ? record_ : record_before_;
        const double time = m.clock.step * static_cast<double>(m.step - from.step);
        FieldValues values;
        for (std::size_t k = 0; k < areas_.size(); ++k) {
            const WearSums& sums = tally_.sums()[k];
            std::vector<double> pressure(areas_[k].size(), kUnknown), wear;
            for (std::size_t t = 0; t < areas_[k].size(); ++t) {
                if (!from.press.empty() && time > 0)
                    pressure[t] = (sums.press[t] - from.press[k][t]) / (time * areas_[k][t]);
                wear.push_back(sums.shear[t] / areas_[k][t]);
            }
            values.push_back(std::move(pressure));
            values.push_back(std::move(wear));
        }
        return values;
    }

    void save(std::ostream& out) const override { name_all(*this, Writing{out}); }
    void load(const ObservedState& m, Bytes& in) override {
        record_.press.resize(areas_.size());
        record_before_.press.resize(areas_.size());
        name_all(*this, Reading{in});
        const auto fits = [&](const Record& record) {
            std::vector<WearSums> sums;
            for (const std::vector<double>& press : record.press) sums.push_back({press, press, press});
            return tally_.fits(sums);
        };
        const bool ended_before = !record_before_.press.empty() && !record_before_.press.front().empty();
        if (!ended_before) record_before_.press.clear();
        if (step_ < 0 || step_ > m.step || record_.step > step_ || record_before_.step > record_.step ||
            record_before_.step < 0 || !tally_.fits(tally_.sums()) || !fits(record_) ||
            (ended_before && !fits(record_before_)))
            in.fail();
    }

  private:
    // The step at which a record begins, and each mesh's sums of normal forces at that step. The sums are
    // empty if they are not known.
    struct Record {
        std::int64_t step = 0;
        std::vector<std::vector<double>> press;  // N s
    };
    template <class Self, class Each>
    static void name_all(Self& self, const Each& each) {
        each(self.step_);
        for (auto& mesh : self.tally_.sums()) each(mesh.press), each(mesh.impact), each(mesh.shear);
        for (auto* record : {&self.record_, &self.record_before_}) {
            each(record->step);
            for (std::size_t k = 0; k < self.areas_.size(); ++k) {
                auto none = std::vector<double>();
                each(k < record->press.size() ? record->press[k] : none);
            }
        }
    }

    // Names of the meshes, which face_names() gives after those of the faces.
    static std::vector<std::string> mesh_names(const Scene& scene) {
        const std::vector<std::string> names = face_names(scene);
        return {names.end() - static_cast<std::ptrdiff_t>(scene.meshes.size()), names.end()};
    }

    void add_mesh(const Scene& scene, std::size_t k, const std::string& name) {
        const Surface& surface = *scene.meshes[k].surface;
        MeasuredAxis axis{"triangle_of_" + name, "1", "triangle of the mesh, as trajectory.nc has them", {}};
        areas_.emplace_back();
        for (std::int32_t t = 0; t < surface.size(); ++t) {
            axis.at.push_back(t);
            areas_.back().push_back(surface.area(t));
        }
        set_.axes.push_back(axis);
        set_.fields.push_back({pressure_field(name),
                               "pressure on " + scene.meshes[k].name,
                               "Pa",
                               "mean normal force divided by the area, for the record",
                               {axis.name}});
        set_.fields.push_back(
            {wear_field(name),
             "wear of " + scene.meshes[k].name,
             "J m-2",
             "work of the tangential forces divided by the area, since the drive started until the "
             "end of the record",
             {axis.name}});
    }
    std::vector<std::vector<double>> presses() const {
        std::vector<std::vector<double>> all;
        for (const WearSums& mesh : tally_.sums()) all.push_back(mesh.press);
        return all;
    }

    const FieldTimes records_;
    WearTally tally_;
    FieldSet set_;
    std::vector<std::vector<double>> areas_;  // m2, of each triangle of each mesh
    std::int64_t step_ = 0;                   // step of the last look
    Record record_, record_before_;           // beginnings of the last two records
};

}  // namespace grainreel::observers
