// How far grains have drifted, on average, in a period of the drive: across the container, in the container's
// own frame.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <ostream>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/measure/flow/velocity_grid.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// A mean and its standard error.
struct Estimate {
    double mean, error;
};

// Compares where each grain is with where it was four periods before. Four is a multiple of the 1, 2 and 4
// periods after which beds repeat themselves, so that bouncing does not count as drift. What is told is the
// mean over the last windows of four periods, four of them at most; errors are standard errors over those
// windows, NaN with one. All NaN before the first window is over.
class Drift {
  public:
    static constexpr int kPeriods = 4;  // of a window
    static constexpr std::size_t kWindows = 4;

    enum Zone : std::size_t { at_left_wall, in_middle, at_right_wall, zones };

    explicit Drift(const Scene& scene);

    // At the beginning of every window, all at one phase; a call at another time than the end of the last
    // window begins anew.
    void note(std::int64_t period, const Grains& grains, const Pose& pose);

    // m a period: mean upward way of the grains of a zone, less that of all grains. In the middle are those
    // of the middle third of the width.
    Estimate rise(Zone zone) const;
    // m a period, mean way along the edge of the bed's left or right half (Circulation::speed), positive
    // where the bed rises in the middle and sinks at the wall.
    Estimate roll(Side half) const;
    // m: in the middle of which flow the half turns, y from the middle of the container, z from its floor.
    RollCentre centre(Side half) const { return half == Side::left ? left_centre_ : right_centre_; }

    // Everything it knows, for the checkpoint; the reading fails where save() could not have written it.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    // One window. m a period.
    struct Window {
        std::array<double, zones> rise{};
        double left_roll = 0, right_roll = 0;
        VelocityGrid grid;
    };
    using Place2 = std::array<double, 2>;  // m: y and z

    Window compare(const Grains& grains, const Pose& pose) const;
    void remember(const Grains& grains, const Pose& pose);
    template <class Value>
    Estimate estimate(const Value& value) const;
    VelocityGrid sum_of_windows() const;
    void find_centres();

    SideWalls walls_;
    double half_width_ = 0;       // m, of the container
    VelocityGrid cells_;          // empty
    std::vector<Place2> before_;  // by id, NaN where there is none
    std::int64_t next_ = -1;      // period that ends the window
    std::deque<Window> windows_;
    RollCentre left_centre_, right_centre_;
};

}  // namespace grainreel
