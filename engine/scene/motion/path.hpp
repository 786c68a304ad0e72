// The motion of a body from a file: places and orientations at rising times, joined by a curve whose velocity
// and acceleration are continuous.
//
// The file is CSV: a header of names, then rows. Columns time_s (or t), x_m, y_m, z_m (or x, y, z), and, if
// wanted, qw, qx, qy, qz. Places count from where the body rests; the quaternion turns it about its place.
// Natural cubic splines (de Boor 1978, A Practical Guide to Splines, ch. IV); before the first time and after
// the last one the body stands where it was then.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

struct PathPose {
    Vec3 place{0, 0, 0};                           // m, from rest
    Quaternion rotation = Quaternion::Identity();  // from rest
    Vec3 velocity{0, 0, 0};                        // m/s
    Vec3 spin{0, 0, 0};                            // rad/s
};

class MotionPath {
  public:
    // Throws UserError with file and line: no numbers, times that do not rise, fewer than 4 rows, a
    // quaternion that is no rotation.
    static std::shared_ptr<const MotionPath> read(const std::filesystem::path& file);

    PathPose at(double time) const;  // s; velocity and spin are the exact derivatives of place and rotation
    double first() const { return times_.front(); }  // s
    double last() const { return times_.back(); }    // s
    double top_speed() const;                        // m/s, the largest between the rows
    double top_spin() const;                         // rad/s
    bool turns() const { return !turns_.empty(); }
    const std::string& hash() const { return hash_; }

  private:
    struct Piece {
        Vec3 c0, c1, c2, c3;  // place = c0 + c1 s + c2 s2 + c3 s3, with s the time since the row before
    };
    struct Turning {
        Eigen::Vector4d c0, c1, c2, c3;  // of the quaternion's numbers, which are then scaled to length 1
    };
    std::vector<double> times_;
    std::vector<Piece> pieces_;
    std::vector<Turning> turns_;  // empty: it does not turn
    std::string hash_;
};

}  // namespace grainreel
