// Convection of a shaken bed: the mean drift of grains in a period of the drive (in the container's frame),
// the rolls in this velocity field, and the observer of both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <ostream>
#include <string>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// A velocity field on equal cells of a plane.
//
// The cells lie in (y, z), with y to the right and z up; cell (j, k) has the index j + k * across. Speeds may
// have any unit: m/s, or m per period.
struct VelocityGrid {
    std::size_t across = 0, high = 0;
    double left = 0, bottom = 0;    // m, the corner of the first cell
    double width = 0, height = 0;   // m, of a cell
    std::vector<double> right, up;  // mean velocity in a cell
    std::vector<double> weight;     // weight of a cell (grains, mass); 0 if it is empty

    std::size_t index(std::size_t j, std::size_t k) const { return j + k * across; }
    double y(std::size_t j) const {
        return left + (static_cast<double>(j) + 0.5) * width;
    }  // y of the column's middle
    double z(std::size_t k) const { return bottom + (static_cast<double>(k) + 0.5) * height; }  // m
};

struct Circulation {
    double along = 0;  // closed integral of u . dl, speed times m; positive counter-clockwise (y to z)
    double edge = 0;   // m, length of the closed line
    double area = 0;   // m2, area inside the line
    // Mean velocity along the line; NaN without one.
    double speed() const { return along / edge; }
};

// The circulation around the part of the field whose cells are filled and have their middles between y = from
// and y = to. By Stokes' theorem the integral around it is the sum of the integrals around all squares
// between the middles of four filled cells, each by the trapezoidal rule, which is exact where u is linear.
// For a rigid rotation by w it is 2 w times the area.
Circulation circulation(const VelocityGrid& grid, double from, double to);

// The stream function psi at the right edge of each cell, by rows as in the grid (speed times m). It is the
// flow up through the row between the left side and this edge: -psi = sum of weight * up * cell width,
// divided by the mean weight of the filled cells. In a steady field as much flows up through a row as down.
// The difference that scatter leaves is spread evenly over the row's weight, so that psi is 0 at the right
// side.
std::vector<double> stream_function(const VelocityGrid& grid);

struct RollCentre {
    double y = kUnknown, z = kUnknown;  // m
    double psi = 0;                     // speed times m; positive where the field turns counter-clockwise
};

// The place where |psi| is largest between y = from and y = to; NaN if nothing turns.
RollCentre roll_centre(const VelocityGrid& grid, const std::vector<double>& psi, double from, double to);

// A mean and its standard error.
struct Estimate {
    double mean, error;
};

// Measures drift by comparing the place of each grain with its place four periods before. Four is a multiple
// of the 1, 2 and 4 periods after which beds repeat themselves, so that bouncing does not count as drift.
// Results are means over the last windows of four periods, at most four of them. Errors are standard errors
// over these windows, and NaN if there is only one. All results are NaN before the first window is over.
class Drift {
  public:
    static constexpr int kPeriods = 4;  // periods of a window
    static constexpr std::size_t kWindows = 4;

    enum Zone : std::size_t { at_left_wall, in_middle, at_right_wall, zones };

    explicit Drift(const Scene& scene);

    // Call this at the beginning of every window, always at the same phase. A call at any other time than the
    // end of the last window begins anew.
    void note(std::int64_t period, const Grains& grains, const DrivePose& pose);

    // Mean upward way (m per period) of the grains of a zone, minus that of all grains. The middle zone is
    // the middle third of the width.
    Estimate rise(Zone zone) const;
    // Mean way (m per period) along the edge of the bed's left or right half (Circulation::speed()), positive
    // if the bed rises in the middle and sinks at the wall.
    Estimate roll(Side half) const;
    // Centre (m) of the roll in a half; y counts from the middle of the container, and z from its floor.
    RollCentre centre(Side half) const { return half == Side::left ? left_centre_ : right_centre_; }

    // Saves and loads everything that it knows, for the checkpoint. Reading fails for anything that save()
    // cannot have written.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    // Results of one window, in m per period.
    struct Window {
        std::array<double, zones> rise{};
        double left_roll = 0, right_roll = 0;
        VelocityGrid grid;
    };
    using Place2 = std::array<double, 2>;  // m: y and z

    Window compare(const Grains& grains, const DrivePose& pose) const;
    void remember(const Grains& grains, const DrivePose& pose);
    template <class Value>
    Estimate estimate(const Value& value) const;
    VelocityGrid sum_of_windows() const;
    void find_centres();

    SideWalls walls_;
    double half_width_ = 0;       // m, of the container
    VelocityGrid cells_;          // the cells, all empty
    std::vector<Place2> before_;  // place of each grain by id; NaN for ids without a grain
    std::int64_t next_ = -1;      // period that ends the window
    std::deque<Window> windows_;
    RollCentre left_centre_, right_centre_;
};

}  // namespace grainreel

// Observer of convection: the drift of the bed at its walls and in its middle, and its rolls.

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
    void start(const ObservedState& m) override {
        if (windows_.next(m.step, clock_) == m.step) gather(m);
    }
    void gather(const ObservedState& m) override {
        drift_.note(std::llround(clock_.cycles(m.step)), m.grains, m.pose);
    }
    void look(const ObservedState&, std::vector<double>& row) override {
        for (const auto zone : {Drift::at_left_wall, Drift::in_middle, Drift::at_right_wall})
            add(row, drift_.rise(zone));
        for (const Side half : {Side::left, Side::right}) add(row, drift_.roll(half));
        for (const Side half : {Side::left, Side::right}) {
            const RollCentre centre = drift_.centre(half);
            row.insert(row.end(), {centre.y, centre.z});
        }
    }

    void save(std::ostream& out) const override { drift_.save(out); }
    void load(const ObservedState&, Bytes& in) override { drift_.load(in); }

  private:
    static void add(std::vector<double>& row, const Estimate& estimate) {
        row.insert(row.end(), {estimate.mean, estimate.error});
    }

    const Rhythm windows_{0, Drift::kPeriods};  // rhythm of the windows, in periods of the drive
    const bool shaken_;
    const Clock clock_;
    Drift drift_;
};

}  // namespace grainreel::observers
