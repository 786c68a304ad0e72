// Convection: how the bed drifts at its walls and in its middle, and how it turns.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/measure/flow/drift.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel::observers {

class Convection final : public Observer {
  public:
    static constexpr const char* instrument = "convection";

    static std::vector<ColumnGroup> columns(const Scene&) {
        const auto length = [](const std::string& name, const std::string& label) {
            return MeasureColumn{name + "_m", label, Dimension::length};
        };
        ColumnGroup rise{
            {},
            "m",
            "mean upward way in a period of the grains beside the left wall, in the middle third and "
            "beside the right wall, less that of all grains; each with its standard error"};
        for (const std::string zone : {"left", "middle", "right"}) {
            const std::string label =
                zone == "middle" ? "rise in the middle" : "rise at the " + zone + " wall";
            rise.columns.push_back(length("flow_" + zone, label));
            rise.columns.push_back(length("flow_" + zone + "_error", "error of the " + label));
        }
        ColumnGroup roll{
            {},
            "m",
            "mean way in a period along the edge of the bed's left and right half, positive where "
            "the bed rises in the middle; each with its standard error"};
        ColumnGroup centre{
            {},
            "m",
            "where the stream function of each half is largest: y and z, from the middle of the "
            "floor"};
        for (const std::string half : {"left", "right"}) {
            roll.columns.push_back(length("roll_" + half, "roll of the " + half + " half"));
            roll.columns.push_back(
                length("roll_" + half + "_error", "error of the roll of the " + half + " half"));
            for (const std::string axis : {"y", "z"})
                centre.columns.push_back(
                    length("roll_" + half + "_" + axis, "centre of the " + half + " roll, " + axis));
        }
        return {rise, roll, centre};
    }
    Convection(const Scene& scene, const Plan& plan)
        : shaken_(plan.clock.steps_per_period > 0), clock_(plan.clock), drift_(scene) {}

    std::int64_t gathers_after(std::int64_t step) const override {
        return shaken_ ? windows_.next(step + 1, clock_) : kNever;
    }
    void start(const Moment& m) override {
        if (windows_.next(m.step, clock_) == m.step) gather(m);
    }
    void gather(const Moment& m) override {
        drift_.note(std::llround(clock_.cycles(m.step)), m.grains, m.pose);
    }
    void look(const Moment&, std::vector<double>& row) override {
        for (const auto zone : {Drift::at_left_wall, Drift::in_middle, Drift::at_right_wall})
            add(row, drift_.rise(zone));
        for (const Side half : {Side::left, Side::right}) add(row, drift_.roll(half));
        for (const Side half : {Side::left, Side::right}) {
            const RollCentre centre = drift_.centre(half);
            row.insert(row.end(), {centre.y, centre.z});
        }
    }

    void save(std::ostream& out) const override { drift_.save(out); }
    void load(const Moment&, Bytes& in) override { drift_.load(in); }

  private:
    static void add(std::vector<double>& row, const Estimate& estimate) {
        row.insert(row.end(), {estimate.mean, estimate.error});
    }

    const Rhythm windows_{0, Drift::kPeriods};  // of periods of the drive
    const bool shaken_;
    const Clock clock_;
    Drift drift_;
};

}  // namespace grainreel::observers
