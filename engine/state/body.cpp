#include "engine/state/body.hpp"

#include "engine/base/rotation.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

std::vector<Body> bodies_of(const Drive& drive, const std::vector<ScenePlane>& planes) {
    std::vector<Body> bodies{
        {kContainerBody, drive.present && drive.moves == Drive::Moves::container, Vec3(0, 0, 0)},
        {kFloorBody, drive.present, Vec3(0, 0, 0)}};
    for (const ScenePlane& plane : planes)
        bodies.push_back({static_cast<std::int32_t>(bodies.size()), plane.moves, plane.velocity});
    return bodies;
}

std::vector<Body> bodies_of(const Scene& scene) {
    std::vector<Body> bodies = bodies_of(scene.drive, scene.walls);
    bodies[kContainerBody].turn = bodies[kFloorBody].turn = scene.container.turn;
    for (const SceneMesh& mesh : scene.meshes) {
        const auto number = static_cast<std::int32_t>(bodies.size());
        bodies.push_back({number, mesh.driven, mesh.velocity, mesh.turn, mesh.path.of});
    }
    return bodies;
}

// Before the motion starts (time 0) nothing has moved. The body is turned first, then displaced.
std::int32_t first_mesh_body(const Scene& scene) {
    return kFirstPlaneBody + static_cast<std::int32_t>(scene.walls.size());
}

BodyPose Body::at(const DrivePose& drive) const {
    BodyPose pose{place_at(drive), Quaternion::Identity(), velocity_at(drive), Vec3(0, 0, 0)};
    if (turn) {
        pose.rotation = rotation_about(turn->axis, turn->angle_at(drive.time));
        pose.spin = turn->rate_at(drive.time) * turn->axis;
        const Vec3 arm =
            pose.rotation * turn->through;  // vector from the body's origin to the point of the axis
        pose.place += turn->through - arm;
        pose.velocity -= pose.spin.cross(arm);
    }
    if (path) {
        const PathPose on_path = path->at(drive.time);
        pose.place += on_path.place;
        pose.rotation = on_path.rotation;
        pose.velocity += on_path.velocity;
        pose.spin = on_path.spin;
    }
    return pose;
}

std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const DrivePose& drive) {
    std::vector<BodyPose> poses;
    for (const Body& body : bodies) poses.push_back(body.at(drive));
    return poses;
}

// The floor follows every drive. Before the drive starts all bodies are at rest.
void add_planes(const std::vector<ScenePlane>& planes, double time, std::vector<BodyPose>& poses) {
    DrivePose drive;
    if (time >= 0) drive = {poses.at(kFloorBody).place, poses.at(kFloorBody).velocity, time};
    const std::vector<Body> bodies = bodies_of({}, planes);
    for (std::size_t b = poses.size(); b < bodies.size(); ++b) poses.push_back(bodies[b].at(drive));
}

}  // namespace grainreel
