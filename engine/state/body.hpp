// Rigid bodies, whose surfaces are faces and meshes, and the drive, which moves some of them (WallMotion).
// The bodies are the container, its floor, each plane of the scene, each mesh, and a tray that never moves.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/vector.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Displacement from rest, and velocity, of everything that the drive moves, at one time.
struct Pose {
    Vec3 offset{0, 0, 0};    // m
    Vec3 velocity{0, 0, 0};  // m/s
    double time = 0;         // s, since the start of the motion
};

// Position and motion of a body. "At rest" means before anything moves. The origin of each body is then the
// origin of the scene.
struct BodyPose {
    Vec3 place{0, 0, 0};                           // m, of the body's origin
    Quaternion rotation = Quaternion::Identity();  // about that origin
    Vec3 velocity{0, 0, 0};                        // m/s, of the origin
    Vec3 spin{0, 0, 0};                            // rad/s

    // moved() takes a point of the body (m) from its place at rest to its place now, and at_rest() takes it
    // back.
    Vec3 moved(const Vec3& at_rest) const { return place + rotation * at_rest; }
    Vec3 at_rest(const Vec3& now) const { return rotation.conjugate() * (now - place); }
    Vec3 velocity_at(const Vec3& now) const { return velocity + spin.cross(now - place); }  // m/s

    bool operator==(const BodyPose& other) const {
        return place == other.place && rotation.coeffs() == other.rotation.coeffs() &&
               velocity == other.velocity && spin == other.spin;
    }
};

// The numbers of a scene's bodies: container and floor, whatever the shape of the container, then the planes
// in their order, then the meshes.
constexpr std::int32_t kContainerBody = 0, kFloorBody = 1, kFirstPlaneBody = 2;
// The number of the tray, which catches what flows out of an outlet. The tray stands still and has no pose in
// files.
constexpr std::int32_t kTrayBody = -1;

// How a body moves: with the drive if `driven`, and on top of that by a steady velocity, a turn or a path of
// its own.
struct Body {
    std::int32_t number = kContainerBody;
    bool driven = false;
    Vec3 velocity{0, 0, 0};  // m/s
    std::optional<BodyTurn> turn = {};
    std::shared_ptr<const MotionPath> path = {};

    bool turns() const { return turn || (path && path->turns()); }
    bool has_own_motion() const { return turn || path; }  // a turn or a path
    BodyPose at(const Pose& drive) const;
    // Displacement and velocity by drive and steady velocity. They hold for all points of the body if
    // has_own_motion() is false.
    Vec3 place_at(const Pose& drive) const {
        return (driven ? drive.offset : Vec3(0, 0, 0)) + drive.time * velocity;
    }
    Vec3 velocity_at(const Pose& drive) const { return (driven ? drive.velocity : Vec3(0, 0, 0)) + velocity; }
};

// All bodies of a scene, by number.
std::vector<Body> bodies_of(const Scene& scene);
// The bodies of a container that does not turn, of its floor and of these planes.
std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes);
inline std::int32_t first_mesh_body(const Scene& scene) {
    return kFirstPlaneBody + static_cast<std::int32_t>(scene.walls.size());
}

// The poses of all bodies.
std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive);

// For frames of files of an earlier version, which hold only container and floor: adds the poses of the
// planes at `time` (s), by the formula that moved them in the run.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses);

// WallMotion gives the pose of the drive at each step.
class WallMotion {
  public:
    WallMotion() = default;  // at rest for ever
    WallMotion(const Drive& drive, const Clock& clock);

    bool moving() const { return moving_; }

    // z_w = a s(t) sin(wt + phi), v_w = a (s w cos(wt + phi) + s' sin(wt + phi)), where s rises from 0 to 1
    // over the ramp as 10u^3 - 15u^4 + 6u^5 (twice differentiable), and u is the share of the ramp that has
    // passed. z_w is the displacement along the drive's direction. Without a ramp, the sine's value at the
    // start is subtracted, z_w = a (sin(wt + phi) - sin phi): the container starts in its place at rest,
    // though not from rest. The phase comes from the step count, so it does not drift. Before step 0 nothing
    // moves.
    Pose at(std::int64_t step) const { return at(step, 0); }
    // The pose between two steps; `share` is the share of the step that has passed, from 0 to 1. For a drive
    // with stages (engine/scene/drive_schedule.hpp), z_w = a sin p, or a (sin p - sin phi) without a ramp.
    // The phase p has no jump between stages, and a and w are constant or change as that file says. With t
    // from the start of a tap, the tap is z_w = a (1 - cos wt): the walls go up and down once, from rest to
    // rest.
    Pose at(std::int64_t step, double share) const;

  private:
    struct Motion {
        double offset = 0, velocity = 0;  // m, m/s
    };
    Motion before_stages(std::int64_t step, double share) const;
    Motion in_stretch(std::size_t index, std::int64_t step, double share) const;
    static Motion tap(const DriveSchedule::Piece& piece, double since);  // `since`: s since the tap began
    std::size_t stretch_at(std::int64_t step) const;

    bool moving_ = false;
    double amplitude_ = 0, angular_frequency_ = 0, ramp_ = 0, start_phase_ = 0, start_sine_ = 0;
    std::vector<DriveSchedule::Piece>
        pieces_;  // what the drive does in each stretch of clock_.changes; empty for a drive without stages
    Vec3 direction_{0, 0, 1};
    Clock clock_;
};

}  // namespace grainreel
