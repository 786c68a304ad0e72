#include "engine/state/body.hpp"

#include <algorithm>

namespace grainreel {

std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes) {
    std::vector<Body> bodies{
        {kContainerBody, drive.present && drive.moves == Drive::Moves::container, Vec3(0, 0, 0)},
        {kFloorBody, drive.present, Vec3(0, 0, 0)}};
    for (const FreeWall& plane : planes)
        bodies.push_back({static_cast<std::int32_t>(bodies.size()), plane.moves, plane.velocity});
    return bodies;
}

std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive) {
    std::vector<BodyPose> poses;
    for (const Body& body : bodies) poses.push_back(body.at(drive));
    return poses;
}

// The floor follows every drive. Before the drive starts all bodies are at rest.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses) {
    Pose drive;
    if (time >= 0) drive = {poses.at(kFloorBody).place, poses.at(kFloorBody).velocity, time};
    const std::vector<Body> bodies = bodies_of({}, planes);
    for (std::size_t b = poses.size(); b < bodies.size(); ++b) poses.push_back(bodies[b].at(drive));
}

}  // namespace grainreel
