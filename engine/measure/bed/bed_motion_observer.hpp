// How the bed as a whole moves: when it flies, and how far it has expanded.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/measure/bed/flight.hpp"
#include "engine/measure/heights.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/walls/turning.hpp"

namespace grainreel::observers {

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

    BedMotion(const Scene&, const Plan& plan)
        : every_(std::max<std::int64_t>(1, plan.clock.steps_per_period / kLooks)),
          shaken_(plan.clock.steps_per_period > 0),
          flight_(plan.clock.steps_per_period) {}

    bool needs_wall_sums() const override { return true; }
    std::int64_t gathers_after(std::int64_t step) const override {
        if (!shaken_) return step < 0 ? 0 : kNever;  // the bed at rest is wanted all the same
        return (step + every_) / every_ * every_;
    }
    void start(const Moment& m) override {
        rest_height_ = height_of(m);
        note(m);
    }
    void gather(const Moment& m) override {
        if (has_floor(m) && m.step > step_) flight_.add(step_, carried(m));
        note(m);
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.push_back(rest_height_ > 0 ? height_of(m) / rest_height_ : kNoValue);
        const std::optional<Flight::Times> last = flight_.last();
        if (!last) return add_no_values(row, 3);
        row.insert(row.end(), {m.clock.phase(last->from), m.clock.phase(last->to),
                               m.clock.cycles(last->to) - m.clock.cycles(last->from)});
    }
    void save(std::ostream& out) const override {
        const Writing each{out};
        each(rest_height_), each(step_), each(floor_), each(flight_.state());
    }
    void load(const Moment& m, Bytes& in) override {
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
    static constexpr std::int64_t kLooks = 128;  // a period

    static bool has_floor(const Moment& m) {
        return m.scene.container.shape != Container::Shape::none && m.wall_sums != nullptr;
    }
    // A vessel that is a mesh has no floor of its own and carries the grains as a whole.
    static const FaceSums& floor_of(const Moment& m) {
        const std::optional<std::size_t> vessel = vessel_of(m.scene);
        return m.wall_sums->faces.at(vessel ? m.faces.size() + *vessel : 0);
    }
    static double height_of(const Moment& m) {
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        return bed_height(heights);
    }
    void note(const Moment& m) {
        step_ = m.step;
        if (has_floor(m)) floor_ = floor_of(m);
    }
    // Mean force of the grains on the floor along gravity since the step before, over their weight. The sums
    // are those of walls/wall_forces.hpp.
    double carried(const Moment& m) const {
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
    double rest_height_ = kNoValue;  // m
    Flight flight_;
    std::int64_t step_ = 0;  // of the last look at the floor
    FaceSums floor_;         // at that step
};

}  // namespace grainreel::observers
