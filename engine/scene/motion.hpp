// Motions that a body may have of its own. MotionPath follows a path from a file: places and orientations at
// rising times, joined by a curve whose velocity and acceleration are continuous. BodyTurn is a steady turn.
//
// The file of a path is CSV: a header of names, then rows. Its columns are time_s (or t), x_m, y_m, z_m (or
// x, y, z) and, if wanted, qw, qx, qy, qz. Places count from the body's place at rest. The quaternion turns
// the body about its pivot, which moves with it. The curve is a natural cubic spline (de Boor 1978, A
// Practical Guide to Splines, ch. IV). The quaternion's four numbers have splines too and are then scaled to
// unit length. Before the first time and after the last one the body stands still.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Natural cubic splines: the curve through points at rising times whose second derivative is continuous, and
// zero at both ends. de Boor 1978, A Practical Guide to Splines, ch. IV.

// value = c0 + c1 s + c2 s^2 + c3 s^3, with s the time since the piece's beginning. V is a vector of fixed
// size.
template <class V>
struct CubicPiece {
    V c0, c1, c2, c3;
    V value(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
    V slope(double s) const { return c1 + s * (2 * c2 + 3 * s * c3); }
};

// Returns one piece between every two neighbouring points. There are at least two times, which rise, and as
// many points.
template <class V>
std::vector<CubicPiece<V>> natural_spline(const std::vector<double>& times, const std::vector<V>& points) {
    const std::size_t last = times.size() - 1;
    const auto width = [&](std::size_t i) { return times[i + 1] - times[i]; };
    const auto rise = [&](std::size_t i) { return V((points[i + 1] - points[i]) / width(i)); };
    // The second derivatives m solve h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (rise[i] -
    // rise[i-1]). They are found by elimination; `beyond` holds what is left above the diagonal.
    std::vector<V> second(times.size(), V::Zero());
    std::vector<double> beyond(times.size(), 0.0);
    for (std::size_t i = 1; i < last; ++i) {
        const double pivot = 2 * (width(i - 1) + width(i)) - width(i - 1) * beyond[i - 1];
        beyond[i] = width(i) / pivot;
        second[i] = (6 * (rise(i) - rise(i - 1)) - width(i - 1) * second[i - 1]) / pivot;
    }
    for (std::size_t i = last; i-- > 1;) second[i] -= beyond[i] * second[i + 1];

    std::vector<CubicPiece<V>> pieces;
    pieces.reserve(last);
    for (std::size_t i = 0; i < last; ++i) {
        const double h = width(i);
        pieces.push_back({points[i], rise(i) - h / 6 * (2 * second[i] + second[i + 1]), 0.5 * second[i],
                          (second[i + 1] - second[i]) / (6 * h)});
    }
    return pieces;
}

// x = place + rotation * x at rest, as in BodyPose.
struct PathPose {
    Vec3 place{0, 0, 0};                           // m
    Quaternion rotation = Quaternion::Identity();  // from rest
    Vec3 velocity{0, 0, 0};                        // m/s
    Vec3 spin{0, 0, 0};                            // rad/s
};

class MotionPath {
  public:
    // `pivot` (m, at rest) is the mesh's position. Throws UserError with file and line for: values that are
    // not numbers, times that do not rise or begin after 0, fewer than 4 rows, a quaternion that is no
    // rotation, a path that at 0 s is not where the mesh rests, and jumps. A jump is a step of more than a
    // twentieth of the path's size that is more than 20 times as fast as those before and after it; a single
    // row that lies as far from both its neighbours; or a turn of more than 2 rad from row to row, whose
    // sense would be unclear. Jumps of places are looked for only in files of 8 rows or more.
    static std::shared_ptr<const MotionPath> read(const std::filesystem::path& file,
                                                  const Vec3& pivot = Vec3(0, 0, 0));

    PathPose at(double time) const;  // s; velocity and spin are the exact derivatives of place and rotation
    const Vec3& pivot() const { return pivot_; }     // m, at rest
    double first() const { return times_.front(); }  // s
    double last() const { return times_.back(); }    // s
    // Largest speeds, looked up at sixteen times between every two rows. A point at a distance r from the
    // pivot is at most top_speed() + r * top_spin() fast at these times.
    double top_speed() const { return top_speed_; }  // m/s, of the pivot
    double top_spin() const { return top_spin_; }    // rad/s
    bool turns() const { return !turns_.empty(); }
    const std::string& hash() const { return hash_; }

  private:
    struct Moment {
        std::size_t piece;
        double since;  // s, since the row before
        bool still;    // before the first row, or after the last one
    };
    Moment moment_at(double time) const;
    void find_tops();

    std::vector<double> times_;
    std::vector<CubicPiece<Vec3>> pieces_;
    std::vector<CubicPiece<Eigen::Vector4d>>
        turns_;  // components w, x, y, z; empty when the body does not turn
    Vec3 pivot_{0, 0, 0};
    double top_speed_ = 0, top_spin_ = 0;
    std::string hash_;
};

// The rows of a path's file, checked one by one. Internal to MotionPath.

struct PathRows {
    std::vector<std::int64_t> lines;  // line number in the file, from 1
    std::vector<double> times;
    std::vector<Vec3> places;
    std::vector<Eigen::Vector4d> turns;  // unit, w first, each with the sign that is nearer to the one
                                         // before; empty if the body does not turn
};

// Throws UserError as MotionPath::read does.
PathRows read_path_rows(const std::filesystem::path& file);

// A steady turn about an axis, with a smooth beginning and end.

// The rate rises from 0 to `rate` within `over` seconds from `from` on, as 10u^3 - 15u^4 + 6u^5 (the
// drive's ramp does the same). From `until` on it falls back in the same way.
struct BodyTurn {
    Vec3 axis{0, 0, 1};                                      // unit
    Vec3 through{0, 0, 0};                                   // m, a point of the axis
    double rate = 0;                                         // rad/s, by the right-hand rule
    double from = 0;                                         // s
    double over = 0;                                         // s; 0: at once
    double until = std::numeric_limits<double>::infinity();  // s

    double angle_at(double time) const;  // rad since the start; exact integral of the rate
    double rate_at(double time) const;   // rad/s
    bool operator==(const BodyTurn&) const = default;
};

}  // namespace grainreel
