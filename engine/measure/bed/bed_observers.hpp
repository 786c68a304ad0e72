// Observers of the bed as a whole: its shape and motion, its centre of mass, its contacts and a single
// intruder. Each class gives columns of measures.csv; the formulas are in bed_formulas.hpp.
#pragma once

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/measure/bed/bed_formulas.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel::observers {

// Observer of the bed's height and density.
class BedShape final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"bed_top_m", "height of the bed", Dimension::length}},
             "m",
             "height above the floor below which 95 % of all centres lie"},
            {{{"bed_solid_fraction", "solid fraction of the bed"}},
             "1",
             "volume of the grains up to `bed_top_m` over that of the container between floor and there"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (m.grains.size() == 0) return add_no_values(row, 2);
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        const double height = bed_height(heights), top = m.floor_height() + height;
        row.insert(row.end(), {height, solid_fraction(m.scene.container, m.grains, m.pose.offset.z(), top)});
    }
};

// Observer of the motion of the bed as a whole: its flights and its expansion.
class BedMotion final : public Observer {
  public:
    static constexpr const char* instrument = "bed";

    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"bed_expansion", "expansion of the bed"}},
             "1",
             "`bed_top_m` over that of the bed at rest, when the drive started; NaN where there were no "
             "grains then"},
            {{{"takeoff_turns", "phase of take-off (turns)"}, {"landing_turns", "phase of landing (turns)"}},
             "turns, 0 to 1",
             "phase of the drive at which the last flight began and ended: the floor carries less than a "
             "tenth of the weight, until it carries more than half"},
            {{{"flight_periods", "time of flight (periods)"}}, "periods", "how long it took"}};
    }

    static std::string why_empty(const Scene& scene, const std::string& column) {
        if (column == "bed_expansion") return "";
        if (!scene.drive.present) return "the bed flies in periods of the drive, and nothing is driven";
        return scene.container.shape == Container::Shape::none ? "there is no floor from which the bed flies"
                                                               : "";
    }
    BedMotion(const Scene&, const Plan& plan)
        : every_(std::max<std::int64_t>(1, plan.clock.steps_per_period / kLooks)),
          shaken_(plan.clock.steps_per_period > 0),
          flight_(plan.clock.steps_per_period) {}

    bool needs_wall_sums() const override { return true; }
    std::int64_t gathers_after(std::int64_t step) const override {
        if (!shaken_) return step < 0 ? 0 : kNever;  // only the bed at rest is needed then
        return (step + every_) / every_ * every_;
    }
    void start(const ObservedState& m) override {
        rest_height_ = height_of(m);
        note(m);
    }
    void gather(const ObservedState& m) override {
        if (has_floor(m) && m.step > step_) flight_.add(step_, carried(m));
        note(m);
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.push_back(rest_height_ > 0 ? height_of(m) / rest_height_ : kUnknown);
        const std::optional<Flight::Times> last = flight_.last();
        if (!last) return add_no_values(row, 3);
        row.insert(row.end(), {m.clock.phase(last->from), m.clock.phase(last->to),
                               m.clock.cycles(last->to) - m.clock.cycles(last->from)});
    }
    void save(std::ostream& out) const override {
        const Writing each{out};
        each(rest_height_), each(step_), each(floor_), each(flight_.state());
    }
    void load(const ObservedState& m, Bytes& in) override {
        const Reading each{in};
        Flight::State state;
        each(rest_height_), each(step_), each(floor_), each(state);
        const auto past = [&](std::int64_t step) { return step >= 0 && step <= m.step; };
        if (!std::isfinite(rest_height_) || !past(step_) || !past(state.since) || !past(state.last.from) ||
            !past(state.last.to) || !are_sound(std::vector<FaceSums>{floor_}))
            in.fail();
        flight_.set(state);
    }

  private:
    static constexpr std::int64_t kLooks = 128;  // looks per period

    static bool has_floor(const ObservedState& m) {
        return m.scene.container.shape != Container::Shape::none && m.wall_sums != nullptr;
    }
    // A vessel that is a mesh has no floor of its own, so the whole mesh counts as the floor.
    static const FaceSums& floor_of(const ObservedState& m) {
        const std::optional<std::size_t> vessel = vessel_of(m.scene);
        return m.wall_sums->faces.at(vessel ? m.faces.size() + *vessel : 0);
    }
    static double height_of(const ObservedState& m) {
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        return bed_height(heights);
    }
    void note(const ObservedState& m) {
        step_ = m.step;
        if (has_floor(m)) floor_ = floor_of(m);
    }
    // Mean force of the grains on the floor along gravity since the last look, divided by their weight. The
    // sums are those that walls/wall_forces_observer.hpp describes.
    double carried(const ObservedState& m) const {
        const FaceSums& now = floor_of(m);
        double counts = 0, mass = 0;  // counts times m/s2
        for (int a = 0; a < 3; ++a)
            counts += m.gravity[a] *
                      (static_cast<double>(now.force[a] - floor_.force[a]) +
                       m.wall_sums->felt * static_cast<double>(now.last_force[a] - floor_.last_force[a]));
        for (std::size_t i = 0; i < m.grains.size(); ++i) mass += m.grains.mass(i);
        return counts * m.wall_sums->scale.force /
               (mass * m.gravity.squaredNorm() * static_cast<double>(m.step - step_));
    }

    const std::int64_t every_;  // steps
    const bool shaken_;
    double rest_height_ = kUnknown;  // m
    Flight flight_;
    std::int64_t step_ = 0;  // step of the last look at the floor
    FaceSums floor_;         // sums at that step
};

// Observer of the number of periods after which the bed repeats itself.
class BedPeriods final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"bed_periods", "periods until the bed repeats itself"}},
                 "periods",
                 "of the drive, after which the bed repeats itself, as far as is known by then (see "
                 "[below](#beds-that-land-every-second-period)); 0 without a drive"},
                {{{"period_difference_m", "difference between periods", Dimension::length}},
                 "m",
                 "root mean square difference between the heights of the bed's centre of mass in a period "
                 "and in the one before; 0 until eight periods have been seen"}};
    }

    BedPeriods(const Scene& scene, const Plan& plan) : clock_(plan.clock), multiple_(mean_diameter(scene)) {}

    std::int64_t gathers_after(std::int64_t step) const override {
        return is_shaken() ? looks().next(step + 1, clock_) : kNever;
    }
    void start(const ObservedState& m) override {
        if (is_shaken() && looks().next(m.step, clock_) == m.step) gather(m);
    }
    void gather(const ObservedState& m) override {
        multiple_.add(std::llround(clock_.cycles(m.step) * PeriodMultiple::kPhases), centre_height(m));
    }
    void look(const ObservedState&, std::vector<double>& row) override {
        row.insert(row.end(),
                   {is_shaken() ? static_cast<double>(multiple_.value()) : 0.0, multiple_.difference()});
    }
    void save(std::ostream& out) const override { multiple_.save(out); }
    void load(const ObservedState&, Bytes& in) override { multiple_.load(in); }

  private:
    // Height of the centre of mass above the present place of the floor, m.
    static double centre_height(const ObservedState& m) {
        double moment = 0, mass = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            moment += m.grains.mass(i) * m.grains.place[i].position.z();
            mass += m.grains.mass(i);
        }
        return moment / mass - m.floor_height();
    }
    bool is_shaken() const { return clock_.steps_per_period > 0; }
    Rhythm looks() const {
        if (clock_.changes.empty())
            return Rhythm(static_cast<double>(clock_.steps_per_period / PeriodMultiple::kPhases));
        return Rhythm(0, 1.0 / PeriodMultiple::kPhases);
    }

    const Clock clock_;
    PeriodMultiple multiple_;
};

// Observer of the centre of mass of all grains.
class CentreOfMass final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"centre_x_m", "centre of mass, x", Dimension::length},
                  {"centre_y_m", "centre of mass, y", Dimension::length},
                  {"centre_z_m", "centre of mass, z", Dimension::length}},
                 "m",
                 "centre of mass of all grains"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        Vec3 centre = Vec3::Zero();
        double mass = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            centre += m.grains.mass(i) * m.grains.place[i].position;
            mass += m.grains.mass(i);
        }
        centre /= mass;
        row.insert(row.end(), {centre.x(), centre.y(), centre.z()});
    }
};

// Observer of the mean place of the grains of each species. Every grain counts alike, whatever its mass.
class SpeciesPlaces final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups;
        for (const Species& species : scene.species) {
            const std::string& name = species.name;
            ColumnGroup centre{{}, "m", "mean position of a species, every grain counted alike"};
            for (const char* axis : {"x", "y", "z"})
                centre.columns.push_back({column_part(name) + "_centre_" + axis + "_m",
                                          "centre of " + name + ", " + axis, Dimension::length});
            groups.push_back(std::move(centre));
            groups.push_back(
                {{{column_part(name) + "_height_m", "mean height of " + name, Dimension::length}},
                 "m",
                 "mean height of its centres above the floor where the floor is now"});
        }
        return groups;
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        const std::size_t species = m.scene.species.size();
        std::vector<Vec3> centre(species, Vec3::Zero());
        std::vector<double> count(species, 0);
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            const auto s = static_cast<std::size_t>(m.grains.species[i]);
            centre[s] += m.grains.place[i].position;
            count[s] += 1;
        }
        const std::vector<double> height = mean_heights(m.grains, species, m.floor_height());
        for (std::size_t s = 0; s < species; ++s) {
            centre[s] /= count[s];
            row.insert(row.end(), {centre[s].x(), centre[s].y(), centre[s].z(), height[s]});
        }
    }
};

// Observer of the mean number of contacts that carry a grain.
class ContactNumber final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"contact_number", "contacts per grain"}},
                 "1",
                 "force-carrying contacts a grain, walls included"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const ObservedState&) override { carrying_ = 0; }
    void contact(const ObservedState&, const ContactView& c) override {
        if (c.normal_force > 0) carrying_ += c.second >= 0 ? 2 : 1;
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.push_back(carrying_ / static_cast<double>(m.grains.size()));
    }

  private:
    double carrying_ = 0;  // number of contacts that carry force; a pair counts for both grains
};

// Observer of the largest overlap of two bodies.
class LargestOverlap final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"largest_overlap", "largest overlap / radius"}},
                 "1",
                 "largest overlap of a contact, divided by the smaller radius (the plan's `run.overlap` is "
                 "divided by the diameter)"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const ObservedState&) override { largest_ = 0; }
    void contact(const ObservedState&, const ContactView& c) override {
        largest_ = std::max(largest_, c.overlap / c.smaller_radius);
    }
    void look(const ObservedState&, std::vector<double>& row) override { row.push_back(largest_); }

  private:
    double largest_ = 0;
};

// How the contacts between grains are oriented.
class ContactFabric final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"fabric_anisotropy", "fabric anisotropy"}},
             "1",
             "largest less smallest eigenvalue of the fabric tensor of the force-carrying contacts between "
             "grains: 0 without a preferred direction, 1 all parallel"},
            {{{"fabric_vertical", "vertical fabric"}},
             "1",
             "zz component of that tensor: 1/3 without a preferred direction, more where contacts are "
             "upright"}};
    }
    bool needs_contacts() const override { return true; }
    void begin(const ObservedState&) override { fabric_ = {}; }
    void contact(const ObservedState&, const ContactView& c) override {
        if (c.normal_force > 0 && c.second >= 0) fabric_.add(c.normal);
    }
    void look(const ObservedState&, std::vector<double>& row) override {
        row.insert(row.end(), {fabric_.anisotropy(), fabric_.vertical()});
    }

  private:
    Fabric fabric_;
};

// Observer of a single large grain: its height in the bed, and the time at which it came up.
class Intruder final : public Observer {
  public:
    static constexpr const char* instrument = "intruder";

    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"intruder_level", "level of the intruder"}},
                 "1",
                 "height of the top of the one grain of the largest species, divided by the height of the "
                 "bed's surface around it; 1 when it comes to the surface"},
                {{{"rise_time_s", "rise time", Dimension::time}},
                 "s",
                 "when `intruder_level` first reached 1; NaN until then"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) {
        if (scene.species.size() < 2)
            return "the intruder is a grain of a second species, and the scene has one";
        const std::int64_t largest = scene.species[big_and_small(scene.species).big].count;
        const bool stays =
            scene.start.packs() && scene.feeds.empty() && scene.exits.empty() && !scene.container.outlet;
        if (largest == 1 || !stays) return "";
        return fmt::format("the intruder is the one grain of the largest species, which has {}", largest);
    }
    Intruder(const Scene&, const Plan& plan) : rows_(plan) {}

    std::int64_t gathers_after(std::int64_t step) const override { return rows_.after(step); }
    void start(const ObservedState& m) override { gather(m); }
    void gather(const ObservedState& m) override {
        if (std::isnan(rise_time_) && height_at(m) >= 1) rise_time_ = m.clock.time(m.step);
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.insert(row.end(), {height_at(m), rise_time_});
    }
    void save(std::ostream& out) const override { write_value(out, rise_time_); }
    void load(const ObservedState& m, Bytes& in) override {
        read_value(in, rise_time_);
        if (rise_time_ < 0 || rise_time_ > m.clock.time(m.step)) in.fail();
    }

  private:
    static double height_at(const ObservedState& m) {
        const std::optional<std::size_t> intruder = find_intruder(m.scene, m.grains);
        return intruder ? intruder_height(m.scene, m.grains, *intruder, m.floor_height()) : kUnknown;
    }

    const Rows rows_;
    double rise_time_ = kUnknown;  // s
};

}  // namespace grainreel::observers
