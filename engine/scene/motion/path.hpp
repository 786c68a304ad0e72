// The motion of a body from a file: places and orientations at rising times, joined by a curve whose velocity
// and acceleration are continuous.
//
// The file is CSV: a header of names, then rows. Columns time_s (or t), x_m, y_m, z_m (or x, y, z), and, if
// wanted, qw, qx, qy, qz. Places count from where the body rests; the quaternion turns it about its pivot,
// which goes with it. Natural cubic splines (de Boor 1978, A Practical Guide to Splines, ch. IV), of the
// quaternion's four numbers too, which are then scaled to length 1. Before the first time and after the last
// one the body stands where it was then.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/motion/spline.hpp"

namespace grainreel {

// x = place + rotation * x at rest, as in BodyPose.
struct PathPose {
    Vec3 place{0, 0, 0};                           // m
    Quaternion rotation = Quaternion::Identity();  // from rest
    Vec3 velocity{0, 0, 0};                        // m/s
    Vec3 spin{0, 0, 0};                            // rad/s
};

class MotionPath {
  public:
    // pivot: m, at rest; a mesh's position. Throws UserError with file and line: no numbers, times that do
    // not rise or begin after 0, fewer than 4 rows, a quaternion that is no rotation, and jumps: a step of
    // more than a twentieth of the path's size that is more than 20 times as fast as those before and after
    // it, a row that alone lies apart likewise, and a turn of more than 2 rad from row to row, which might go
    // either way round.
    static std::shared_ptr<const MotionPath> read(const std::filesystem::path& file,
                                                  const Vec3& pivot = Vec3(0, 0, 0));

    PathPose at(double time) const;  // s; velocity and spin are the exact derivatives of place and rotation
    const Vec3& pivot() const { return pivot_; }     // m, at rest
    double first() const { return times_.front(); }  // s
    double last() const { return times_.back(); }    // s
    // At sixteen times between every two rows. No point farther than r from the pivot is faster than
    // top_speed() + r * top_spin().
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
    std::vector<CubicPiece<Eigen::Vector4d>> turns_;  // of w, x, y, z; empty: it does not turn
    Vec3 pivot_{0, 0, 0};
    double top_speed_ = 0, top_spin_ = 0;
    std::string hash_;
};

}  // namespace grainreel
