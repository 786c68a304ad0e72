// Formulas for the bed as a whole: its solid fraction, the directions of its contacts (Fabric), the height of
// a single large grain, when the bed leaves the floor and lands (Flight), and after how many periods of the
// drive it repeats itself (PeriodMultiple). None needs the step loop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iosfwd>
#include <optional>

#include "engine/base/binary.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Volume of the grains below `top`, divided by the container's volume between `floor` and `top` (both m, in
// the frame of the scene). A grain that reaches through the plane z = top counts by its part below it: a cap
// of height h of a sphere of radius r has the volume pi h^2 (3 r - h) / 3. `top` counts at most as high as
// the container. NaN if there is no container, or if `top` is not above the container's base.
double solid_fraction(const Container& container, const Grains& grains, double floor, double top);

// How the contacts between grains are oriented.
//
// The fabric tensor F = <n n^T> over the unit normals n of contacts: Oda (1982, Soils Found. 22(4), 96),
// Rothenburg & Bathurst (1989, Geotechnique 39, 601). Its trace is 1; F = I / 3 when no direction is
// preferred.
class Fabric {
  public:
    void add(const Vec3& normal) {
        sum_ += normal * normal.transpose();
        contacts_ += 1;
    }
    double contacts() const { return contacts_; }
    // All NaN without contacts.
    Eigen::Matrix3d tensor() const { return sum_ / contacts_; }
    // Largest minus smallest eigenvalue of F: 0 without a preferred direction, 1 when all normals are
    // parallel. NaN without contacts.
    double anisotropy() const;
    // F_zz, the mean square of the cosine between a normal and the vertical: 1/3 without a preferred
    // direction, 1 when all normals are vertical.
    double vertical() const { return tensor()(2, 2); }

  private:
    Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
    double contacts_ = 0;
};

// Index of the intruder: the only grain of the species with the largest mean diameter. Empty if there is only
// one species, or if this species does not have exactly one grain.
std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains);

// Height of the intruder's top divided by the height of the bed's surface around it, both above the floor. It
// is 1 when the intruder comes to the surface. The surface is that of the other grains (surface.hpp) in a
// square around the intruder which reaches two of their mean diameters beyond it. NaN without other grains
// there.
double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor);

// Finds flights of the bed. Its input is the mean force on the floor, divided by the bed's weight, for one
// stretch of steps after the other. The bed flies from the beginning of the first stretch in which the floor
// carries less than a tenth of the weight to the beginning of the first one in which it carries more than
// half. So a few grains that stay behind, or jump, neither end a flight nor make one. Flights shorter than a
// sixteenth of a period are the bed's own vibrations and do not count.
//
// An inelastic block on a plate leaves it where the plate's acceleration is that of gravity, at the phase
// asin(1 / Gamma) / (2 pi) of a sine.
class Flight {
  public:
    static constexpr double kLeaves = 0.1, kLands = 0.5;  // as a share of the weight

    struct Times {
        std::int64_t from = 0, to = 0;  // steps
    };

    explicit Flight(std::int64_t period) : least_(period / 16) {}

    // Adds the stretch that begins at step `from` and ends where the stretch of the next call begins.
    // `carried` is the mean force on the floor in it, divided by the weight.
    void add(std::int64_t from, double carried);

    // The last flight that has ended.
    std::optional<Times> last() const { return state_.any ? std::optional(state_.last) : std::nullopt; }

    // Everything that a Flight knows. Checkpoints hold it as it lies in memory.
    struct State {
        std::int64_t since = 0;  // step at which the present flight began
        Times last;
        bool flying = false;
        bool any = false;                  // whether a flight has ended
        std::array<char, 6> nothing = {};  // no byte is left undefined, so equal states are equal in files
    };
    static_assert(std::has_unique_object_representations_v<State>);
    const State& state() const { return state_; }
    void set(const State& state) { state_ = state; }

  private:
    const std::int64_t least_;  // steps
    State state_;
};

// Finds after how many periods of the drive the bed repeats itself. A bed that is thrown so high that it
// lands only in every second period repeats itself after two. An inelastic block on a plate does so above
// sqrt(pi^2 + 4) g.
//
// It sees the height of the bed's centre of mass at the same phases of every period, and compares each period
// with the one before it, with the one before that, and so on.
class PeriodMultiple {
  public:
    static constexpr int kPhases = 8;   // moments in a period, evenly spaced
    static constexpr int kMost = 4;     // largest multiple that can be found, periods
    static constexpr int kWindow = 4;   // periods over which differences are taken
    static constexpr int kConfirm = 3;  // periods for which a multiple above 1 must have held before value()
                                        // leaves 1
    static constexpr int kChange = 10;  // periods for which another multiple must have held before value()
                                        // changes again, so that a short slip does not count

    // `diameter` (m) is that of a grain. Periods that differ by less than a tenth of it are equal.
    explicit PeriodMultiple(double diameter) : least_(0.1 * diameter) {}

    // Adds the height (m) above the floor at phase number `number`. The number counts on from period to
    // period and starts anywhere. After a gap everything begins anew.
    void add(std::int64_t number, double height);

    // Number of periods; 1 until another multiple is known.
    int value() const { return value_; }
    // Root mean square difference (m) between a period and the one before it.
    double difference() const { return difference_; }

    // Saves and loads everything that it knows, for the checkpoint.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    void end_period();
    double difference_to(int periods_before) const;
    int multiple_now() const;

    const double least_;          // m
    std::deque<double> heights_;  // m, heights of whole periods
    std::int64_t next_ = -1;      // next number that is expected
    int value_ = 1, other_ = 1, confirmed_ = 0;
    double difference_ = 0;
};

}  // namespace grainreel
